// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/answer_budget.hpp"

#include <gtest/gtest.h>

namespace carpus::server {
namespace {

AnswerBudget::Body body_of(std::size_t bytes) {
  return std::make_shared<const std::string>(bytes, 'x');
}

TEST(AnswerBudget, AdmitsUntilItIsUsedUpAndAgainWhenOneHasLeft) {
  AnswerBudget budget(100'000);
  auto first = budget.admit(body_of(60'000));
  ASSERT_TRUE(first.has_value());
  EXPECT_FALSE(budget.admit(body_of(60'000)).has_value());
  EXPECT_TRUE(budget.admit(body_of(40'000)).has_value());
  first.reset();
  EXPECT_TRUE(budget.admit(body_of(60'000)).has_value());
}

TEST(AnswerBudget, CountsABodyThatIsSharedOnce) {
  AnswerBudget budget(100'000);
  const auto scene = body_of(90'000);
  auto one = budget.admit(scene);
  auto two = budget.admit(scene);
  ASSERT_TRUE(one.has_value() && two.has_value());
  one.reset();
  EXPECT_FALSE(budget.admit(body_of(20'000)).has_value());
  two.reset();
  EXPECT_TRUE(budget.admit(body_of(20'000)).has_value());
}

TEST(AnswerBudget, LetsOneLargeAnswerPassAloneAndSmallOnesAlways) {
  AnswerBudget budget(10'000);
  auto large = budget.admit(body_of(1'000'000));
  ASSERT_TRUE(large.has_value());
  EXPECT_FALSE(budget.admit(body_of(5'000)).has_value());
  EXPECT_TRUE(budget.admit(body_of(AnswerBudget::kSmallBytes)).has_value());
  AnswerBudget::Share moved = std::move(*large);
  large.reset();
  EXPECT_FALSE(budget.admit(body_of(5'000)).has_value());
  moved = {};
  EXPECT_TRUE(budget.admit(body_of(5'000)).has_value());
}

}  // namespace
}  // namespace carpus::server
