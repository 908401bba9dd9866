// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The page's own files: what lies below one folder, and nothing else.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "server/http_message.hpp"

namespace carpus::server {

/// The decoded path of a request target, without its query: "/a%20b?x" is "/a b". Nothing where it
/// is malformed or tries to leave its root: no leading slash, "." and ".." and empty segments,
/// hidden names, backslashes, control characters.
[[nodiscard]] std::optional<std::string> decode_path(std::string_view target);

/// The type that a browser must be told for a file of this name; "application/octet-stream" for
/// endings that a page does not use.
[[nodiscard]] std::string_view media_type_of(std::string_view file_name) noexcept;

class StaticFiles {
 public:
  /// @throws InvalidInput  the folder has no index.html: the page was not built, or it is another.
  explicit StaticFiles(const std::filesystem::path& root);

  /// The file at a decoded path; "/" is index.html. 404 where there is none below the root, also
  /// when a symbolic link leads out of it.
  [[nodiscard]] HttpResponse get(std::string_view path) const;

 private:
  std::filesystem::path root_;
};

}  // namespace carpus::server
