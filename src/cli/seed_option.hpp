// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <string>

namespace carpus::cli {

/// A whole number of at most 64 bits and nothing else; -1 does not become the largest.
inline CLI::Validator whole_number() {
  const auto refusal = [](const std::string& text) -> std::string {
    std::uint64_t value = 0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, value);
    if (error == std::errc{} && end == last) return {};
    return "'" + text + "' is no whole number from 0 to 18446744073709551615";
  };
  return {refusal, "WHOLE NUMBER"};
}

/// `--seed N`
inline void add_seed_option(CLI::App& command, std::uint64_t& seed, const std::string& of_what) {
  command.add_option("--seed", seed, of_what)->check(whole_number())->capture_default_str();
}

}  // namespace carpus::cli
