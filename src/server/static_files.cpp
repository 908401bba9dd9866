// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/static_files.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "core/error.hpp"

namespace carpus::server {

namespace {

namespace fs = std::filesystem;

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

bool is_allowed_in_path(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x20 && byte != 0x7F && c != '\\' && c != ':';
}

/// Every segment is a plain name.
bool has_plain_segments(std::string_view path) {
  if (path.empty() || path.front() != '/') return false;
  if (path == "/") return true;
  std::size_t begin = 1;
  while (begin <= path.size()) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    if (end == begin || path[begin] == '.') return false;
    begin = end + 1;
  }
  return true;
}

bool lies_below(const fs::path& file, const fs::path& root) {
  const auto [in_root, in_file] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
  return in_root == root.end() && in_file != file.end();
}

HttpResponse not_found() { return make_problem(404, "There is no such page here."); }

}  // namespace

std::optional<std::string> decode_path(std::string_view target) {
  target = target.substr(0, target.find_first_of("?#"));
  std::string path;
  for (std::size_t i = 0; i < target.size(); ++i) {
    char c = target[i];
    if (c == '%') {
      if (i + 2 >= target.size()) return std::nullopt;
      const int high = hex_value(target[i + 1]);
      const int low = hex_value(target[i + 2]);
      if (high < 0 || low < 0) return std::nullopt;
      c = static_cast<char>(high * 16 + low);
      // An encoded slash would make another path than the one that was checked.
      if (c == '/') return std::nullopt;
      i += 2;
    }
    if (!is_allowed_in_path(c)) return std::nullopt;
    path += c;
  }
  if (!has_plain_segments(path)) return std::nullopt;
  return path;
}

std::string_view media_type_of(std::string_view file_name) noexcept {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 15> kTypes{{
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".mjs", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".json", "application/json"},
      {".map", "application/json"},
      {".webmanifest", "application/manifest+json"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".jpg", "image/jpeg"},
      {".ico", "image/x-icon"},
      {".woff2", "font/woff2"},
      {".wasm", "application/wasm"},
      {".glb", "model/gltf-binary"},
      {".txt", "text/plain; charset=utf-8"},
  }};
  for (const auto& [ending, type] : kTypes) {
    if (file_name.ends_with(ending)) return type;
  }
  return "application/octet-stream";
}

StaticFiles::StaticFiles(const fs::path& root) {
  std::error_code error;
  root_ = fs::canonical(root, error);
  if (error || !fs::is_regular_file(root_ / "index.html", error)) {
    throw InvalidInput("web folder " + root.string() +
                       ": no index.html in it; build the page (./run --build-only) or name its "
                       "folder with --web");
  }
}

HttpResponse StaticFiles::get(std::string_view path) const {
  if (!has_plain_segments(path)) return not_found();
  const fs::path name = path == "/" ? fs::path("index.html") : fs::path(path.substr(1));
  std::error_code error;
  const fs::path file = fs::canonical(root_ / name, error);
  if (error || !lies_below(file, root_) || !fs::is_regular_file(file, error)) return not_found();
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return not_found();
  std::string content{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  HttpResponse response =
      make_response(200, std::string(media_type_of(file.filename().string())), std::move(content));
  // The build gives everything in assets/ a name that changes with its content.
  response.cache_control =
      path.starts_with("/assets/") ? "public, max-age=31536000, immutable" : "no-cache";
  return response;
}

}  // namespace carpus::server
