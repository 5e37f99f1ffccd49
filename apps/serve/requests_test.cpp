// Requests that wait and those that nobody wants any more: numbers may be used again once they are answered.
#include "apps/serve/requests.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <vector>

namespace scumble::serve {
namespace {

using nlohmann::json;

struct Pipe {
  int from = -1, to = -1;
  Pipe() {
    int ends[2];
    if (::pipe(ends) == 0) from = ends[0], to = ends[1];
  }
  ~Pipe() { ::close(from), ::close(to); }
};

class ServeRequests : public ::testing::Test {
 protected:
  // As a client writes them, before it goes.
  void give(const std::string& lines) {
    Pipe in;
    ASSERT_EQ(::write(in.to, lines.data(), lines.size()), ssize_t(lines.size()));
    ::close(in.to);
    in.to = -1;
    requests.read(in.from);
  }
  // Answers since the last time, a line each; there must be some.
  std::vector<json> answered() {
    char bytes[1 << 16];
    const ssize_t got = ::read(out.from, bytes, sizeof bytes);
    std::vector<json> all;
    std::string line;
    for (ssize_t i = 0; i < got; ++i) {
      line += bytes[i];
      if (bytes[i] != '\n') continue;
      all.push_back(json::parse(line));
      line.clear();
    }
    return all;
  }
  Pipe out;
  Answers answers{out.to};
  Requests requests{answers};
};

TEST_F(ServeRequests, areTakenInTheirOrder) {
  give("{\"id\": 3, \"do\": \"a\"}\n\n  \n{\"id\": 1, \"do\": \"b\"}\n");
  EXPECT_EQ(requests.take()->at("id"), 3);
  EXPECT_EQ(requests.take()->at("do"), "b");
  EXPECT_EQ(requests.take(), std::nullopt);
}

TEST_F(ServeRequests, aNumberMayBeUsedAgainOnceItIsAnswered) {
  give("{\"id\": 5, \"do\": \"a\"}\n{\"id\": 5, \"do\": \"b\"}\n");
  const std::vector<json> refused = answered();
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_EQ(refused[0].at("id"), 5);
  EXPECT_EQ(refused[0].at("error").at("where"), "id");
  EXPECT_EQ(requests.take()->at("do"), "a");
  requests.done(5);
  give("{\"id\": 5, \"do\": \"c\"}\n");
  EXPECT_EQ(requests.take()->at("do"), "c");
}

TEST_F(ServeRequests, whatIsCancelledIsSoUntilItIsAnswered) {
  give(
      "{\"id\": 5, \"do\": \"a\"}\n{\"id\": 6, \"do\": \"b\"}\n{\"id\": 7, \"do\": \"cancel\", \"of\": 5}\n");
  EXPECT_EQ(answered().at(0), (json{{"id", 7}, {"done", json::object()}}));
  EXPECT_TRUE(requests.isCancelled(5));
  EXPECT_FALSE(requests.isCancelled(6));
  // It is still taken, since it is to be answered.
  EXPECT_EQ(requests.take()->at("id"), 5);
  EXPECT_TRUE(requests.isCancelled(5));
  requests.done(5);
  EXPECT_FALSE(requests.isCancelled(5));
  // Another one of that number is wanted.
  give("{\"id\": 5, \"do\": \"c\"}\n");
  EXPECT_FALSE(requests.isCancelled(5));
}

TEST_F(ServeRequests, whatIsNotThereIsNotCancelledLater) {
  give("{\"id\": 7, \"do\": \"cancel\", \"of\": 5}\n{\"id\": 5, \"do\": \"a\"}\n");
  EXPECT_FALSE(requests.isCancelled(5));
}

TEST_F(ServeRequests, whatIsNoRequestIsAnsweredAtOnce) {
  const std::string deep(40, '[');
  struct Case {
    std::string line;
    json id;
  };
  const std::vector<Case> cases{{"no json", nullptr},
                                {"[1, 2]", nullptr},
                                {"{\"do\": \"a\"}", nullptr},
                                {"{\"id\": -1, \"do\": \"a\"}", nullptr},
                                {"{\"id\": 1.5, \"do\": \"a\"}", nullptr},
                                {"{\"id\": 9007199254740994, \"do\": \"a\"}", nullptr},
                                {"{\"id\": 4}", 4},
                                {"{\"id\": 4, \"do\": 1}", 4},
                                {"{\"id\": 4, \"do\": \"cancel\"}", 4},
                                {"{\"id\": 4, \"do\": \"cancel\", \"of\": 1, \"more\": 1}", 4},
                                {"{\"id\": 4, \"do\": " + deep + "}", nullptr}};
  for (const Case& c : cases) {
    give(c.line + "\n");
    const std::vector<json> all = answered();
    ASSERT_EQ(all.size(), 1u) << c.line;
    EXPECT_EQ(all[0].at("id"), c.id) << c.line;
    EXPECT_EQ(all[0].at("error").at("kind"), "usage") << c.line;
  }
  EXPECT_EQ(requests.take(), std::nullopt);
}

}  // namespace
}  // namespace scumble::serve
