// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The outcome of parsing untrusted bytes, where bad input is normal. Has the shape of std::expected
// (C++23), which replaces it later.
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "core/check.hpp"

namespace carpus {

/// Why something was refused, in words for the sender or the log.
struct Refusal {
  std::string reason;
};

/// Either a T or the reason why there is none.
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}            // NOLINT(google-explicit-constructor)
  Result(Refusal refusal) : state_(std::move(refusal)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] bool has_value() const noexcept { return std::holds_alternative<T>(state_); }
  [[nodiscard]] explicit operator bool() const noexcept { return has_value(); }
  [[nodiscard]] const T& value() const {
    CARPUS_CHECK(has_value());
    return *std::get_if<T>(&state_);
  }
  [[nodiscard]] T& value() {
    CARPUS_CHECK(has_value());
    return *std::get_if<T>(&state_);
  }
  [[nodiscard]] const T& operator*() const { return value(); }
  [[nodiscard]] const T* operator->() const { return &value(); }
  [[nodiscard]] const std::string& error() const {
    CARPUS_CHECK(!has_value());
    return std::get_if<Refusal>(&state_)->reason;
  }

 private:
  std::variant<T, Refusal> state_;
};

}  // namespace carpus
