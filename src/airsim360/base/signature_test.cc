#include "airsim360/base/signature.h"

#include <gtest/gtest.h>

#include "airsim360/base/error.h"

namespace airsim360 {
namespace {

// RFC 8032, 7.1, test 1, its secret key in the wrapping of RFC 8410.
constexpr char kKey[] =
    "-----BEGIN PRIVATE KEY-----\nMC4CAQAwBQYDK2VwBCIEIJ1hsZ3v/VpguoRK9JLsLMREScVpezJpGXA7rAMcrn9g\n-----END PRIVATE KEY-----\n";
constexpr char kPublic[] = "d75a980182b10ab7d54bfed3c964073a0ee172f3daa62325af021a68f707511a";
constexpr char kSigned[] =
    "e5564300c360ac729086e2cc806e828a84877f1eb8e5d974d873e065224901555fb8821590a33bacc61e39701cf9b46bd25bf5f0595bbe24655141438e7a100b";

TEST(Signature, IsThatOfTheRfc) {
  EXPECT_EQ(PublicKeyOf(kKey), kPublic);
  EXPECT_EQ(SignText(kKey, ""), kSigned);
  EXPECT_TRUE(IsSignedBy(kPublic, "", kSigned));
}

TEST(Signature, HoldsForItsTextAndKeyAlone) {
  const std::string signature = SignText(kKey, "a run");
  EXPECT_TRUE(IsSignedBy(kPublic, "a run", signature));
  EXPECT_FALSE(IsSignedBy(kPublic, "a ruN", signature));
  EXPECT_FALSE(IsSignedBy(std::string(64, '0'), "a run", signature));
  for (const std::string& bad : {std::string(), std::string("zz"), std::string(128, 'x'), signature.substr(1)})
    EXPECT_FALSE(IsSignedBy(kPublic, "a run", bad));
}

TEST(Signature, WhatIsNoKeyIsRefused) {
  for (const char* bad : {"", "key", "-----BEGIN PRIVATE KEY-----\nAAAA\n-----END PRIVATE KEY-----\n"})
    EXPECT_THROW(SignText(bad, "a"), InputError);
}

}  // namespace
}  // namespace airsim360
