// A request's members at their bounds, by a table: what each way to ask for one takes, and what it refuses.
#include "apps/serve/members.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace scumble::serve {
namespace {

using nlohmann::json;

TEST(ServeMembers, areTakenAndRefusedAtTheirBounds) {
  using Ask = std::function<void(Members&)>;
  const Ask flag = [](Members&m) { (void)m.flag("x"); }, text = [](Members&m) { (void)m.text("x"); },
            number = [](Members&m) { (void)m.number("x"); },
            whole = [](Members&m) { (void)m.whole("x", 10); },
            two = [](Members&m) { (void)m.numbers("x", 2); }, vector = [](Members&m) { (void)m.vector("x"); },
            matrix = [](Members&m) { (void)m.matrix("x"); }, texts = [](Members&m) { (void)m.texts("x"); },
            word =
                [](Members&m) {
                  (void)m.word("x", {"one", "two"});
                },
            list = [](Members&m) { (void)m.list("x"); }, needed = [](Members&m) { (void)m.require("x"); },
            neededText = [](Members&m) { (void)m.requireText("x"); },
            neededWhole = [](Members&m) { (void)m.requireWhole("x", 10); };
  const json sixteen = json::array({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  json fifteen = sixteen;
  fifteen.erase(15);
  struct Case {
    const char* what;
    const Ask& ask;
    std::vector<json> taken, refused;
  };
  for (const Case& c :
       {Case{"flag", flag, {true, false}, {0, 1, "true", json::array()}},
        Case{"text", text, {"", "a"}, {1, true, json::array()}},
        Case{"number", number, {0, -1.5, 1e300}, {"1", true, json::array({1})}},
        Case{"whole", whole, {0, 10, 10.0}, {-1, 11, 1.5, 10.5, "1", 1e300}},
        Case{"two numbers",
             two,
             {json::array({1, 2})},
             {json::array({1}), json::array({1, 2, 3}), 1, json::array({1, "2"}), json::array({1, 1e300})}},
        Case{"vector", vector, {json::array({1, 2, 3})}, {json::array({1, 2}), json::array({1, 2, 3, 4})}},
        Case{"matrix", matrix, {sixteen}, {fifteen, json::array({sixteen})}},
        Case{"texts",
             texts,
             {json::array(), json::array({"a", ""})},
             {"a", json::array({1}), json::array({"a", nullptr})}},
        Case{"word", word, {"one", "two"}, {"three", "", "One", 0}},
        Case{"list", list, {json::array(), json::array({1})}, {"a", json::object()}},
        Case{"needed", needed, {0, "", false}, {}}, Case{"needed text", neededText, {""}, {1}},
        Case{"needed whole", neededWhole, {0, 10}, {11, -1, "1"}}}) {
    const auto refusal = [&](const json& request) {
      Members members(request, "at");
      try {
        c.ask(members);
        members.end();
      } catch (const Refusal& refused) {
        return refused.error.jsonPath;
      }
      return std::string();
    };
    for (const json& value : c.taken) EXPECT_EQ(refusal({{"x", value}}), "") << c.what << " " << value;
    for (const json& value : c.refused) EXPECT_EQ(refusal({{"x", value}}), "at.x") << c.what << " " << value;
    // A member that is missing, or null, is so to all that may be left out.
    const bool isNeeded = std::string(c.what).starts_with("needed");
    for (const json& request : {json::object(), json{{"x", nullptr}}})
      EXPECT_EQ(refusal(request), isNeeded ? "at.x" : "") << c.what;
    EXPECT_EQ(refusal({{"x", c.taken[0]}, {"y", 1}}), "at.y") << c.what << ": what nobody asks for";
  }
  for (const json& none : {json(1), json::array(), json("a"), json(nullptr)})
    EXPECT_THROW(Members(none, ""), Refusal) << none;
}

TEST(ServeMembers, areGivenAsTheyAre) {
  const json request = {{"v", {1, 2, 3}},
                        {"w", "two"},
                        {"n", 7},
                        {"m", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}}};
  Members members(request, "");
  EXPECT_EQ(members.vector("v"), glm::dvec3(1, 2, 3));
  EXPECT_EQ(members.word("w", {"one", "two"}), 1u);
  EXPECT_EQ(members.whole("n", 7), 7u);
  // Column by column.
  EXPECT_EQ((*members.matrix("m"))[3], glm::dvec4(13, 14, 15, 16));
  EXPECT_FALSE(members.flag("none"));
  members.end();
}

}  // namespace
}  // namespace scumble::serve
