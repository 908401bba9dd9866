// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/collide_arguments.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"

namespace carpus::cli {
namespace {

std::string refusal_of_pose(const std::string& text) {
  try {
    (void)parse_pose("--pose-b", text);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

std::string refusal_of_method(const std::string& name) {
  try {
    (void)method_named(name);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(CollideArguments, ReadAPoseOfAPlaceAndAQuaternion) {
  const Placement turned = parse_pose("--pose-a", "1,-2,3e1,0.70710678,0,0,0.70710678");
  EXPECT_EQ(turned.translation, (Vec3{1, -2, 30}));
  EXPECT_NEAR(distance(turned.rotation * Vec3{1, 0, 0}, {0, 1, 0}), 0, 1e-12);
  EXPECT_EQ(parse_pose("--pose-a", "1,2,3").rotation, Mat3::identity());
  EXPECT_EQ(parse_pose("--pose-a", "").translation, Vec3{});
  EXPECT_EQ(parse_vector("--sweep", "-1,0,2.5"), (Vec3{-1, 0, 2.5}));
}

TEST(CollideArguments, RefuseWhatIsNoPoseSayingWhatIsWrong) {
  EXPECT_NE(refusal_of_pose("1,2").find("there are 2"), std::string::npos);
  EXPECT_NE(refusal_of_pose("1,2,x").find("'x' is not a number"), std::string::npos);
  EXPECT_NE(refusal_of_pose("1,2,").find("'' is not a number"), std::string::npos);
  EXPECT_NE(refusal_of_pose("1,2,nan").find("not finite"), std::string::npos);
  EXPECT_NE(refusal_of_pose("1,2,1e999").find("not finite"), std::string::npos);
  EXPECT_NE(refusal_of_pose("0,0,0,1,1,0,0").find("length 1.41421"), std::string::npos);
  EXPECT_NE(refusal_of_pose("0,0,0,0,0,0,0").find("length 0"), std::string::npos);
  EXPECT_NE(refusal_of_pose("1,2").find("--pose-b"), std::string::npos);
  EXPECT_THROW((void)parse_vector("--sweep", "1,2,3,4"), UsageError);
}

TEST(CollideArguments, NameMethodsThatAreNear) {
  EXPECT_EQ(method_named("ivri").name, "ivri");
  EXPECT_NE(refusal_of_method("irvi").find("near: ivri"), std::string::npos);
  EXPECT_NE(refusal_of_method("growth").find("lp_growth"), std::string::npos);
  EXPECT_EQ(refusal_of_method("zzzzzzzz").find("near"), std::string::npos);
  EXPECT_NE(refusal_of_method("zzzzzzzz").find("--method list"), std::string::npos);
}

}  // namespace
}  // namespace carpus::cli
