// The scene that a client describes: textures, materials, meshes and nodes by keys of its own.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "client_memory.h"
#include "scumble/scene_editor.h"

namespace scumble::serve {

class ServedScene {
 public:
  ServedScene() : editor_("served") {}

  // One edit, as docs/serve.md has it. Of a node that was there a part may have been done where it is
  // refused.
  void edit(const nlohmann::json& edit, const std::string& where, const ClientMemory& memory);
  void clear();
  Result<Scene> scene() const { return editor_.scene(); }
  NodeId nodeOf(const std::string& key, const std::string& where) const;
  // How much of each kind there is.
  nlohmann::json counts() const;

 private:
  struct Texture {
    TextureId id;
  };
  struct Material {
    MaterialId id;
    std::set<std::string> textures;
  };
  struct Mesh {
    MeshId id;
    std::set<std::string> materials;
  };
  struct Node {
    NodeId id;
    std::string parent, mesh;
  };
  // An editor takes nothing away. What is removed is made small, and its number serves for what is added
  // next, a node's for one below the same parent.
  template <class Item>
  struct Kind {
    std::map<std::string, Item> items;
    std::vector<Item> free;
  };

  // The number of what is set by a key: its own, one that is free, or a new one.
  template <class Item, class Set, class Add>
  static auto put(Kind<Item>& kind, const std::string& key, const std::string& where, Set set, Add add);
  void setTexture(Members& members, const std::string& key, const ClientMemory& memory);
  void setMaterial(Members& members, const std::string& key);
  void setMesh(Members& members, const std::string& key, const ClientMemory& memory);
  void setNode(Members& members, const std::string& key, const ClientMemory& memory);
  void remove(size_t kind, const std::string& key, const std::string& where);
  TextureSlot slotOf(Members& members, const char* name, std::set<std::string>& used) const;

  SceneEditor editor_;
  Kind<Texture> textures_;
  Kind<Material> materials_;
  Kind<Mesh> meshes_;
  Kind<Node> nodes_;
};

}  // namespace scumble::serve
