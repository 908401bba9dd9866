// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The secret parts of the links by which people come in, one for each role. They are kept in a file
// of the station's owner, so that a station that was started anew knows the pages of before.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace carpus::server {

/// 192 random bits, written with 32 letters of RFC 4648 §5.
inline constexpr std::size_t kTokenLength = 32;

/// Unguessable, from the system's random source.
[[nodiscard]] std::string make_token();

/// Whether this has the form of a token.
[[nodiscard]] bool is_token(std::string_view text) noexcept;

/// Takes as long for a wrong text as for the right one of its length.
[[nodiscard]] bool same_secret(std::string_view one, std::string_view other) noexcept;

struct AccessLinks {
  std::string trainee;
  std::string instructor;
  bool operator==(const AccessLinks&) const = default;
};

[[nodiscard]] AccessLinks make_access_links();

/// Reads the file, or makes it (readable by its owner alone) where there is none.
/// @param anew  replaces what it held: whoever came in by an older link is out
/// @throws IoError  it cannot be read or written, is no such file, or others may read it.
[[nodiscard]] AccessLinks keep_access_links(const std::filesystem::path& file, bool anew);

}  // namespace carpus::server
