#include "bindings.h"

#include <gtest/gtest.h>

#include <set>

#include "base/test_folder.h"
#include "tests/support/asset_files.h"

namespace scumble::viewer {
namespace {

TEST(Bindings, aKeyHasOneMeaning) {
  std::set<std::pair<int, int>> keys;
  for (const Binding& binding : bindings()) {
    EXPECT_TRUE(keys.insert({binding.key, binding.modifiers}).second) << binding.name;
    EXPECT_EQ(commandOf(binding.key, binding.modifiers), binding.command);
  }
  EXPECT_TRUE(bindings().front().meaning);
  EXPECT_FALSE(commandOf(bindings().front().key, ~0));
}

TEST(Bindings, thePageHasThemAll) {
  const std::string page = contentOf((test::kSource / "docs/viewer.md").string());
  for (const HelpRow& row : helpRows())
    EXPECT_NE(page.find("| " + row.names + " | " + row.meaning + " |"), std::string::npos) << row.names;
}

}  // namespace
}  // namespace scumble::viewer
