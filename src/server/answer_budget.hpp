// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How much memory the answers that are on their way may take together. A body that several wait
// for, such as the scene, counts once.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

namespace carpus::server {

class AnswerBudget {
 public:
  using Body = std::shared_ptr<const std::string>;
  /// What is no longer than this always passes: a refusal must.
  static constexpr std::size_t kSmallBytes = 4096;

  explicit AnswerBudget(std::size_t bytes) : limit_(bytes) {}
  AnswerBudget(const AnswerBudget&) = delete;
  AnswerBudget& operator=(const AnswerBudget&) = delete;

  /// A body on its way; gives its place back when it goes. Must not outlive the budget.
  class Share {
   public:
    Share() = default;
    Share(AnswerBudget& budget, Body body) : budget_(&budget), body_(std::move(body)) {}
    Share(Share&& other) noexcept
        : budget_(std::exchange(other.budget_, nullptr)), body_(std::move(other.body_)) {}
    Share& operator=(Share&& other) noexcept {
      std::swap(budget_, other.budget_);
      std::swap(body_, other.body_);
      return *this;
    }
    ~Share() {
      if (budget_ != nullptr) budget_->release(body_);
    }
    [[nodiscard]] const std::string& text() const { return *body_; }

   private:
    AnswerBudget* budget_ = nullptr;
    Body body_;
  };

  /// Nothing when too much is on its way already; a single answer may be as large as it is.
  [[nodiscard]] std::optional<Share> admit(Body body) {
    const auto found = holders_.find(body.get());
    if (found != holders_.end()) {
      ++found->second;
    } else {
      const bool is_small = body->size() <= kSmallBytes;
      if (!is_small && used_ > 0 && used_ + body->size() > limit_) return std::nullopt;
      holders_.emplace(body.get(), 1);
      used_ += body->size();
    }
    return Share(*this, std::move(body));
  }

 private:
  void release(const Body& body) {
    const auto found = holders_.find(body.get());
    if (--found->second > 0) return;
    used_ -= body->size();
    holders_.erase(found);
  }

  std::size_t limit_;
  std::size_t used_ = 0;
  std::unordered_map<const std::string*, std::size_t> holders_;
};

}  // namespace carpus::server
