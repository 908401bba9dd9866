// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/surface_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

#include "case_io/detail/disk_space.hpp"
#include "case_io/detail/regular_file.hpp"
#include "case_io/detail/text_lines.hpp"
#include "case_io/ply.hpp"
#include "case_io/stl.hpp"
#include "core/error.hpp"

namespace carpus::case_io {
namespace {

namespace fs = std::filesystem;

std::string extension_of(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Before a file of any size is read in vain.
void check_is_surface(const fs::path& file) {
  const std::string extension = extension_of(file);
  for (const char* known : {".ply", ".stl", ".obj", ".off", ".xyz"}) {
    if (extension == known) return;
  }
  throw IoError(file.string() + ": is of no known format; give .ply, .stl, .obj, .off or .xyz");
}

Vec3 point_at(const TextLines& lines, std::size_t first_word) {
  return {lines.number(first_word), lines.number(first_word + 1), lines.number(first_word + 2)};
}

void add_polygon(const TextLines& lines,
                 const std::vector<std::int64_t>& polygon,
                 std::size_t vertices,
                 TriangleMesh& mesh) {
  if (polygon.size() < 3) lines.refuse("a facet has fewer than three corners");
  for (const std::int64_t v : polygon) {
    if (v < 0 || v >= static_cast<std::int64_t>(vertices)) {
      lines.refuse("a facet names a vertex that is not there");
    }
  }
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    mesh.facets.push_back({static_cast<std::uint32_t>(polygon[0]),
                           static_cast<std::uint32_t>(polygon[i]),
                           static_cast<std::uint32_t>(polygon[i + 1])});
  }
}

TriangleMesh read_xyz(TextLines& lines) {
  TriangleMesh mesh;
  while (lines.next()) mesh.vertices.push_back(point_at(lines, 0));
  return mesh;
}

TriangleMesh read_obj(TextLines& lines) {
  TriangleMesh mesh;
  std::vector<std::int64_t> polygon;
  while (lines.next()) {
    const auto& words = lines.words();
    if (words[0] == "v") mesh.vertices.push_back(point_at(lines, 1));
    if (words[0] != "f") continue;
    polygon.clear();
    for (std::size_t i = 1; i < words.size(); ++i) {  // v, v/vt, v//vn, v/vt/vn
      const std::int64_t v = lines.integer_of(words[i].substr(0, words[i].find('/')));
      // Counted from 1, or backwards from the last one so far.
      polygon.push_back(
          v > 0 ? v - 1 : (v == 0 ? -1 : static_cast<std::int64_t>(mesh.vertices.size()) + v));
    }
    add_polygon(lines, polygon, mesh.vertices.size(), mesh);
  }
  return mesh;
}

TriangleMesh read_off(TextLines& lines) {
  if (!lines.next() || lines.words()[0] != "OFF") lines.refuse("an OFF file begins with OFF");
  std::size_t counts_at = 1;  // they may stand on the first line or the next
  if (lines.words().size() == 1) {
    counts_at = 0;
    if (!lines.next()) lines.refuse("the counts of vertices and facets are missing");
  }
  const std::int64_t vertices = lines.integer(counts_at);
  const std::int64_t facets = lines.integer(counts_at + 1);
  if (vertices < 0 || facets < 0 || vertices > std::numeric_limits<std::uint32_t>::max()) {
    lines.refuse("an impossible count of vertices or facets");
  }
  TriangleMesh mesh;
  for (std::int64_t i = 0; i < vertices; ++i) {
    if (!lines.next()) lines.refuse("fewer vertices than promised");
    mesh.vertices.push_back(point_at(lines, 0));
  }
  std::vector<std::int64_t> polygon;
  for (std::int64_t i = 0; i < facets; ++i) {
    if (!lines.next()) lines.refuse("fewer facets than promised");
    const std::int64_t corners = lines.integer(0);
    if (corners < 0 || corners >= static_cast<std::int64_t>(lines.words().size())) {
      lines.refuse("a facet names fewer corners than promised");
    }
    polygon.clear();
    for (std::int64_t k = 1; k <= corners; ++k) {
      polygon.push_back(lines.integer(static_cast<std::size_t>(k)));
    }
    add_polygon(lines, polygon, mesh.vertices.size(), mesh);
  }
  if (lines.next()) lines.refuse("more lines than vertices and facets were promised");
  return mesh;
}

/// The shortest digits that read back as the same double.
void append(std::string& text, double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.append(digits.data(), end);
}

/// @param faces  each a range of indices.
template <class Faces>
void write_obj_or_off(const fs::path& file,
                      bool is_obj,
                      std::span<const Vec3> vertices,
                      const Faces& faces,
                      std::span<const Vec3> normals = {}) {
  std::string text = is_obj ? "# carpus, mm\n"
                            : "OFF\n" + std::to_string(vertices.size()) + " " +
                                  std::to_string(faces.size()) + " 0\n";
  const auto append_line = [&text](const char* begin, const Vec3& p) {
    text += begin;
    append(text, p.x);
    text += ' ';
    append(text, p.y);
    text += ' ';
    append(text, p.z);
    text += '\n';
  };
  for (const Vec3& p : vertices) append_line(is_obj ? "v " : "", p);
  for (const Vec3& n : normals) append_line("vn ", n);
  for (const auto& face : faces) {
    text += is_obj ? "f" : std::to_string(face.size());
    for (const std::uint32_t v : face) {
      const std::string number = std::to_string(is_obj ? v + 1 : v);
      text += ' ' + number;
      if (!normals.empty()) text += "//" + number;
    }
    text += '\n';
  }
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw_cannot_write(file);
}

}  // namespace

TriangleMesh read_surface(const fs::path& file) {
  check_is_surface(file);
  return parse_surface(read_whole_file(file), file);
}

TriangleMesh parse_surface(std::string_view content, const fs::path& file) {
  check_is_surface(file);
  const std::string extension = extension_of(file);
  if (extension == ".ply") return parse_ply_or_points(content, file);
  if (extension == ".stl") return parse_stl(content, file);
  TextLines lines(file, content);
  if (extension == ".obj") return read_obj(lines);
  return extension == ".off" ? read_off(lines) : read_xyz(lines);
}

void write_surface(const fs::path& file, const TriangleMesh& mesh, std::span<const Vec3> normals) {
  const std::string extension = extension_of(file);
  if (extension == ".ply") return write_ply(file, mesh, normals);
  if (extension == ".stl") return write_stl(file, mesh);
  if (extension != ".obj" && extension != ".off") {
    throw IoError(file.string() + ": cannot be written; give .ply, .stl, .obj or .off");
  }
  const bool is_obj = extension == ".obj";
  write_obj_or_off(file, is_obj, mesh.vertices, mesh.facets,
                   is_obj ? normals : std::span<const Vec3>{});
}

void write_polygons(const fs::path& file,
                    std::span<const Vec3> vertices,
                    std::span<const std::vector<std::uint32_t>> faces) {
  const std::string extension = extension_of(file);
  if (extension != ".obj" && extension != ".off") {
    throw IoError(file.string() + ": whole faces can be written as .obj or .off only");
  }
  write_obj_or_off(file, extension == ".obj", vertices, faces);
}

std::vector<Vec2> read_planar_points(const fs::path& file) {
  return parse_planar_points(read_whole_file(file), file);
}

std::vector<Vec2> parse_planar_points(std::string_view content, const fs::path& file) {
  TextLines lines(file, content, " \t\r,;");
  std::vector<Vec2> points;
  bool is_first = true;
  while (lines.next()) {
    const bool is_heading = is_first && !lines.is_number(0);
    is_first = false;
    if (is_heading) continue;
    if (lines.words().size() > 2 && lines.is_number(2)) {
      lines.refuse("three numbers, a point in space; give those as .xyz, or two columns only");
    }
    points.push_back({lines.number(0), lines.number(1)});
  }
  return points;
}

}  // namespace carpus::case_io
