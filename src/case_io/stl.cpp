// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/stl.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <string>
#include <tuple>

#include "case_io/detail/disk_space.hpp"
#include "case_io/detail/text_lines.hpp"
#include "core/error.hpp"

namespace carpus::case_io {
namespace {

static_assert(std::endian::native == std::endian::little, "STL is written as memory lies");

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kFacetBytes = 50;  ///< normal, three corners, two bytes of attributes

/// Gives equal corners one vertex.
class SharedVertices {
 public:
  explicit SharedVertices(TriangleMesh& mesh) : mesh_(mesh) {}
  std::uint32_t index_of(const Vec3& p) {
    const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
    const auto [at, is_new] = index_.try_emplace({p.x, p.y, p.z}, next);
    if (is_new) mesh_.vertices.push_back(p);
    return at->second;
  }

 private:
  TriangleMesh& mesh_;
  std::map<std::tuple<double, double, double>, std::uint32_t> index_;
};

TriangleMesh read_binary(const std::filesystem::path& file, std::string_view content) {
  TriangleMesh mesh;
  SharedVertices shared(mesh);
  for (std::size_t at = kHeaderBytes + 4; at < content.size(); at += kFacetBytes) {
    std::array<float, 12> values{};
    std::memcpy(values.data(), content.data() + at, sizeof values);
    Triangle t{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p{values[3 + 3 * k], values[4 + 3 * k], values[5 + 3 * k]};
      if (!is_finite(p)) {
        throw IoError(file.string() + ": has a corner that is not finite; export it again");
      }
      t[k] = shared.index_of(p);
    }
    mesh.facets.push_back(t);
  }
  return mesh;
}

TriangleMesh read_text(const std::filesystem::path& file, std::string_view content) {
  TriangleMesh mesh;
  SharedVertices shared(mesh);
  TextLines lines(file, content);
  Triangle t{};
  std::size_t corners = 0;
  bool is_ended = false;
  while (lines.next()) {
    is_ended = lines.words()[0] == "endsolid";
    if (lines.words()[0] == "endfacet") {
      if (corners != 3) lines.refuse("a facet of STL has three corners");
      mesh.facets.push_back(t);
      corners = 0;
    }
    if (lines.words()[0] != "vertex") continue;
    if (corners == 3) lines.refuse("a facet of STL has three corners");
    t[corners++] = shared.index_of({lines.number(1), lines.number(2), lines.number(3)});
  }
  if (corners != 0) lines.refuse("the last facet is cut short");
  if (!is_ended) lines.refuse("its last line is not endsolid: it is cut short");
  return mesh;
}

/// Whether the file is exactly as long as a binary header says. Some binary files begin with
/// "solid" too, so the word decides nothing.
bool is_binary(std::string_view content) {
  if (content.size() < kHeaderBytes + 4) return false;
  std::uint32_t count = 0;
  std::memcpy(&count, content.data() + kHeaderBytes, sizeof count);
  return content.size() == kHeaderBytes + 4 + kFacetBytes * static_cast<std::size_t>(count);
}

}  // namespace

TriangleMesh parse_stl(std::string_view content, const std::filesystem::path& file) {
  if (is_binary(content)) return read_binary(file, content);
  if (!content.starts_with("solid")) {
    throw IoError(file.string() +
                  ": is neither text STL nor as long as its binary header says; copy or export it "
                  "again");
  }
  return read_text(file, content);
}

void write_stl(const std::filesystem::path& file, const TriangleMesh& mesh) {
  std::string content = "carpus, mm";
  content.resize(kHeaderBytes, ' ');
  const auto append = [&](const auto& value) {
    content.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const auto append_vector = [&](const Vec3& v) {
    for (const double c : {v.x, v.y, v.z}) append(static_cast<float>(c));
  };
  append(static_cast<std::uint32_t>(mesh.facets.size()));
  for (const Triangle& t : mesh.facets) {
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3& b = mesh.vertices[t[1]];
    const Vec3& c = mesh.vertices[t[2]];
    append_vector(normalized_or(cross(b - a, c - a), {0, 0, 0}));
    append_vector(a);
    append_vector(b);
    append_vector(c);
    append(std::uint16_t{0});
  }
  std::ofstream out(file, std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out) throw_cannot_write(file);
}

}  // namespace carpus::case_io
