#include "film/cryptomatte.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace scumble::film {
namespace {

// Published test vectors of MurmurHash3_x86_32: every length of the rest, and bytes above 127.
TEST(Cryptomatte, hashIsMurmurs) {
  EXPECT_EQ(murmurHash3("", 0), 0u);
  EXPECT_EQ(murmurHash3("", 1), 0x514e28b7u);
  EXPECT_EQ(murmurHash3("", 0xffffffffu), 0x81f16f39u);
  EXPECT_EQ(murmurHash3("\xff\xff\xff\xff"), 0x76293b50u);
  EXPECT_EQ(murmurHash3("!Ce\x87"), 0xf55b516bu);
  EXPECT_EQ(murmurHash3("!Ce"), 0x7e4a8634u);
  EXPECT_EQ(murmurHash3("!C"), 0xa0f7b07au);
  EXPECT_EQ(murmurHash3("!"), 0x72661cf4u);
  EXPECT_EQ(murmurHash3("Hello, world!", 0x9747b28cu), 0x24884cbau);
}

// The names and numbers of the specification's examples.
TEST(Cryptomatte, namesHaveTheSpecificationsNumbers) {
  EXPECT_EQ(cryptomatteBits("bunny"), 0x13851a76u);
  EXPECT_EQ(cryptomatteBits("default"), 0x42c9679fu);
  EXPECT_EQ(cryptomatteBits("bunny_porcelain_mat"), 0xb24b26d4u);
  EXPECT_NEAR(std::bit_cast<float>(cryptomatteBits("bunny")), 3.36e-27f, 0.01e-27f);
}

TEST(Cryptomatte, everyNumberSurvivesAsAFloat) {
  size_t clamped = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::string name = "object" + std::to_string(i);
    const uint32_t bits = cryptomatteBits(name), hash = murmurHash3(name);
    ASSERT_TRUE(std::isnormal(std::bit_cast<float>(bits))) << name;
    ASSERT_EQ(bits & 0x807fffffu, hash & 0x807fffffu);
    clamped += bits != hash;
  }
  EXPECT_GT(clamped, 50u);  // two of 256 exponents
  EXPECT_LT(clamped, 300u);
}

TEST(Cryptomatte, manifestIsJson) {
  EXPECT_EQ(cryptomatteManifest({}), "{}");
  EXPECT_EQ(cryptomatteManifest({"default", "bunny", "bunny"}),
            R"({"bunny":"13851a76","default":"42c9679f"})");
  EXPECT_EQ(cryptomatteManifest({"a\"b\\\n"}).find(R"({"a\"b\\\n":")"), 0u);
  EXPECT_NE(cryptomatteManifest({"\xff"}).find("\xef\xbf\xbd"), std::string::npos);
}

TEST(Cryptomatte, attributesAreFoundByTheLayersName) {
  const auto attributes = cryptomatteAttributes("CryptoObject", {"bunny"});
  ASSERT_EQ(attributes.size(), 4u);
  // The keys that renderers in use write for these names.
  EXPECT_EQ(attributes[0].first, "cryptomatte/3ae39a5/name");
  EXPECT_EQ(attributes[0].second, "CryptoObject");
  EXPECT_EQ(attributes[1].second, "MurmurHash3_32");
  EXPECT_EQ(attributes[2].second, "uint32_to_float32");
  EXPECT_EQ(attributes[3].first, "cryptomatte/3ae39a5/manifest");
  EXPECT_EQ(cryptomatteAttributes("CryptoAsset", {})[0].first, "cryptomatte/f42029d/name");
}

TEST(Cryptomatte, ranksLieTwoToALayer) {
  const std::vector<std::string> objects = {"bunny", "default"};
  // Three ranks of one pixel; what is nothing covers nothing.
  const Image ranks{1, 1, {"a", "b", "c", "d", "e", "f"}, {2, 0.5f, 1, 0.25f, 0, 0.25f}};
  ASSERT_EQ(problemWithCryptomatte(ranks, objects), "");
  const std::vector<Image> layers = cryptomatteLayers(ranks, objects);
  ASSERT_EQ(layers.size(), 2u);
  EXPECT_EQ(layers[0].channels, (std::vector<std::string>{"R", "G", "B", "A"}));
  EXPECT_EQ(layers[0].pixels, (std::vector<float>{std::bit_cast<float>(0x42c9679fu), 0.5f,
                                                  std::bit_cast<float>(0x13851a76u), 0.25f}));
  EXPECT_EQ(layers[1].pixels, (std::vector<float>{0, 0, 0, 0}));
}

TEST(Cryptomatte, whatIsNoNumberOfANameIsAProblem) {
  for (const float number : {-1.0f, 0.5f, 2.0f, 1e20f, std::numeric_limits<float>::quiet_NaN(),
                             std::numeric_limits<float>::infinity()})
    EXPECT_NE(problemWithCryptomatte({1, 1, {"a", "b"}, {number, 1}}, {"bunny"}), "") << number;
  EXPECT_NE(problemWithCryptomatte({1, 1, {"a", "b", "c"}, {1, 1, 1}}, {"bunny"}), "");
}

}  // namespace
}  // namespace scumble::film
