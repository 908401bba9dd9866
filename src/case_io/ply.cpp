// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/ply.hpp"

#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "case_io/detail/disk_space.hpp"
#include "case_io/detail/regular_file.hpp"
#include "case_io/detail/text_lines.hpp"
#include "core/check.hpp"
#include "core/error.hpp"

namespace carpus::case_io {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written as memory lies");

enum class Scalar { I8, U8, I16, U16, I32, U32, F32, F64 };

struct ScalarName {
  std::string_view name;
  Scalar type;
};
constexpr std::array kScalarNames{
    ScalarName{"char", Scalar::I8},    ScalarName{"int8", Scalar::I8},
    ScalarName{"uchar", Scalar::U8},   ScalarName{"uint8", Scalar::U8},
    ScalarName{"short", Scalar::I16},  ScalarName{"int16", Scalar::I16},
    ScalarName{"ushort", Scalar::U16}, ScalarName{"uint16", Scalar::U16},
    ScalarName{"int", Scalar::I32},    ScalarName{"int32", Scalar::I32},
    ScalarName{"uint", Scalar::U32},   ScalarName{"uint32", Scalar::U32},
    ScalarName{"float", Scalar::F32},  ScalarName{"float32", Scalar::F32},
    ScalarName{"double", Scalar::F64}, ScalarName{"float64", Scalar::F64}};

/// Longest header line and header: far beyond any real one.
constexpr std::size_t kLongestHeader = 8192;

std::optional<Scalar> scalar_of(std::string_view name) {
  for (const ScalarName& s : kScalarNames) {
    if (s.name == name) return s.type;
  }
  return std::nullopt;
}

bool is_whole(std::optional<Scalar> type) {
  return type && *type != Scalar::F32 && *type != Scalar::F64;
}

std::size_t size_of(Scalar type) {
  switch (type) {
    case Scalar::I8:
    case Scalar::U8:
      return 1;
    case Scalar::I16:
    case Scalar::U16:
      return 2;
    case Scalar::I32:
    case Scalar::U32:
    case Scalar::F32:
      return 4;
    case Scalar::F64:
      return 8;
  }
  return 8;
}

template <typename T>
double value_as(const char* bytes) {
  T v;
  std::memcpy(&v, bytes, sizeof v);
  return static_cast<double>(v);
}

double value_at(const char* bytes, Scalar type) {
  switch (type) {
    case Scalar::I8:
      return value_as<std::int8_t>(bytes);
    case Scalar::U8:
      return value_as<std::uint8_t>(bytes);
    case Scalar::I16:
      return value_as<std::int16_t>(bytes);
    case Scalar::U16:
      return value_as<std::uint16_t>(bytes);
    case Scalar::I32:
      return value_as<std::int32_t>(bytes);
    case Scalar::U32:
      return value_as<std::uint32_t>(bytes);
    case Scalar::F32:
      return value_as<float>(bytes);
    case Scalar::F64:
      return value_as<double>(bytes);
  }
  return 0;
}

struct Header {
  std::size_t vertices = 0;
  std::size_t facets = 0;
  std::size_t vertex_stride = 0;
  std::array<std::size_t, 3> place{};  ///< of x, y, z in a vertex
  std::array<std::optional<Scalar>, 3> type{};
  std::array<std::size_t, 3> column{};  ///< of x, y, z among the properties of a vertex
  std::size_t columns = 0;
  Scalar list_count = Scalar::U8;
  Scalar list_index = Scalar::I32;
  bool has_vertices = false;
  bool has_facets = false;
  bool has_list = false;
  bool is_binary = false;
  bool is_text = false;
  std::size_t bytes = 0;  ///< of the header itself
};

enum class Accepted { BinarySurfaces, TextAndPointsToo };

class Parser {
 public:
  Parser(const std::filesystem::path& file, std::string_view content, Accepted accepted)
      : file_(file), content_(content), accepted_(accepted) {}

  TriangleMesh run() {
    read_header();
    if (header_.is_text) return read_text();
    check_length();
    TriangleMesh mesh;
    read_vertices(mesh);
    read_facets(mesh);
    return mesh;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw IoError(file_.string() + ": " + why + "; restore the file or make the case again");
  }

  void read_header() {
    const std::string_view text = content_.substr(0, kLongestHeader);
    constexpr std::string_view kEnd = "end_header\n";
    const std::size_t end = text.find(kEnd);
    if (!text.starts_with("ply\n") || end == std::string_view::npos) refuse("is not a PLY surface");
    header_.bytes = end + kEnd.size();
    std::istringstream lines{std::string(text.substr(4, end - 4))};
    std::string element;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string key;
      words >> key;
      if (key == "format") {
        std::string format;
        words >> format;
        header_.is_binary = format == "binary_little_endian";
        header_.is_text = format == "ascii" && accepted_ == Accepted::TextAndPointsToo;
      } else if (key == "element") {
        read_element(words, element);
      } else if (key == "property") {
        read_property(words, element);
      }
    }
    if (!header_.is_binary && !header_.is_text) refuse("is not binary little-endian PLY");
    const bool needs_list = accepted_ == Accepted::BinarySurfaces || header_.facets > 0;
    if (!header_.type[0] || !header_.type[1] || !header_.type[2] ||
        (needs_list && !header_.has_list)) {
      refuse("lacks x, y, z or the list of facets");
    }
  }

  void read_element(std::istringstream& words, std::string& element) {
    std::string count;
    words >> element >> count;
    std::size_t n = 0;
    const auto [last, error] = std::from_chars(count.data(), count.data() + count.size(), n);
    if (error != std::errc{} || last != count.data() + count.size() || n > UINT32_MAX) {
      refuse("has an impossible count of " + element);
    }
    if (element == "vertex" && !header_.has_vertices && !header_.has_facets) {
      header_.vertices = n;
      header_.has_vertices = true;
    } else if (element == "face" && !header_.has_facets) {
      header_.facets = n;
      header_.has_facets = true;
    } else if (element == "vertex" || element == "face") {
      refuse("has vertices or facets twice, or facets before vertices");
    } else if (n > 0) {
      refuse("holds elements that no surface here has (" + element + ")");
    }
  }

  void read_property(std::istringstream& words, const std::string& element) {
    std::string type;
    words >> type;
    if (element == "face") {
      std::string count;
      std::string index;
      words >> count >> index;
      const auto count_type = scalar_of(count);
      const auto index_type = scalar_of(index);
      if (type != "list" || !is_whole(count_type) || !is_whole(index_type) || header_.has_list) {
        refuse("has facets of another form than one list of vertices");
      }
      header_.list_count = *count_type;
      header_.list_index = *index_type;
      header_.has_list = true;
      return;
    }
    if (element != "vertex") return;  // of an element of which there is none
    const auto scalar = scalar_of(type);
    if (!scalar) refuse("has a vertex property that is no number");
    std::string name;
    words >> name;
    constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i) {
      if (name != kAxes[i]) continue;
      if (header_.type[i]) refuse("has a vertex with " + name + " twice");
      header_.place[i] = header_.vertex_stride;
      header_.type[i] = scalar;
      header_.column[i] = header_.columns;
    }
    ++header_.columns;
    header_.vertex_stride += size_of(*scalar);
  }

  void check_length() const {
    const std::size_t facet_bytes = size_of(header_.list_count) + 3 * size_of(header_.list_index);
    const std::size_t rest = content_.size() - header_.bytes;
    // Divisions, since counts of a hostile header times their size may not fit.
    if (header_.vertices > rest / header_.vertex_stride ||
        header_.facets > (rest - header_.vertices * header_.vertex_stride) / facet_bytes) {
      refuse("is cut short");
    }
  }

  void read_vertices(TriangleMesh& mesh) {
    const char* at = content_.data() + header_.bytes;
    mesh.vertices.reserve(header_.vertices);
    for (std::size_t i = 0; i < header_.vertices; ++i, at += header_.vertex_stride) {
      Vec3 p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = value_at(at + header_.place[k], *header_.type[k]);
      if (!is_finite(p)) refuse("has a vertex that is not finite");
      mesh.vertices.push_back(p);
    }
  }

  void read_facets(TriangleMesh& mesh) {
    const char* at = content_.data() + header_.bytes + header_.vertices * header_.vertex_stride;
    mesh.facets.reserve(header_.facets);
    for (std::size_t f = 0; f < header_.facets; ++f) {
      if (value_at(at, header_.list_count) != 3) refuse("has a facet that is no triangle");
      at += size_of(header_.list_count);
      Triangle t{};
      for (std::uint32_t& v : t) {
        const double index = value_at(at, header_.list_index);
        if (!(index >= 0 && index < static_cast<double>(header_.vertices))) {
          refuse("has a facet with a vertex that is not there");
        }
        v = static_cast<std::uint32_t>(index);
        at += size_of(header_.list_index);
      }
      mesh.facets.push_back(t);
    }
    if (at != content_.data() + content_.size()) refuse("holds more than its header says");
  }

  /// Vertices and facets, one a line; polygons are cut into fans.
  TriangleMesh read_text() {
    TextLines lines(file_, content_.substr(header_.bytes));
    TriangleMesh mesh;
    for (std::size_t i = 0; i < header_.vertices; ++i) {
      if (!lines.next()) refuse("is cut short");
      mesh.vertices.push_back({lines.number(header_.column[0]), lines.number(header_.column[1]),
                               lines.number(header_.column[2])});
    }
    for (std::size_t f = 0; f < header_.facets; ++f) {
      if (!lines.next()) refuse("is cut short");
      const auto corner = [&](std::int64_t i) {
        const std::int64_t v = lines.integer(static_cast<std::size_t>(i) + 1);
        if (v < 0 || v >= static_cast<std::int64_t>(header_.vertices)) {
          refuse("has a facet with a vertex that is not there");
        }
        return static_cast<std::uint32_t>(v);
      };
      const std::int64_t corners = lines.integer(0);
      if (corners < 3) refuse("has a facet of fewer than three corners");
      for (std::int64_t i = 1; i + 1 < corners; ++i)
        mesh.facets.push_back({corner(0), corner(i), corner(i + 1)});
    }
    if (lines.next()) refuse("holds more than its header says");
    return mesh;
  }

  const std::filesystem::path& file_;
  std::string_view content_;
  Accepted accepted_;
  Header header_;
};

}  // namespace

void write_ply(const std::filesystem::path& file,
               const TriangleMesh& mesh,
               std::span<const Vec3> normals,
               std::string_view remark) {
  CARPUS_CHECK(normals.empty() || normals.size() == mesh.vertices.size());
  CARPUS_CHECK(remark.find('\n') == std::string_view::npos);
  std::string content =
      "ply\nformat binary_little_endian 1.0\ncomment carpus, mm, frame Patient (LPS)\n" +
      (remark.empty() ? "" : "comment " + std::string(remark) + "\n") + "element vertex " +
      std::to_string(mesh.vertices.size()) +
      "\nproperty double x\nproperty double y\nproperty double z" +
      (normals.empty() ? "" : "\nproperty float nx\nproperty float ny\nproperty float nz") +
      "\nelement face " + std::to_string(mesh.facets.size()) +
      "\nproperty list uchar int vertex_indices\nend_header\n";
  const auto append = [&](const auto& value) {
    content.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3& p = mesh.vertices[i];
    for (const double v : {p.x, p.y, p.z}) append(v);
    if (normals.empty()) continue;
    for (const double v : {normals[i].x, normals[i].y, normals[i].z}) append(static_cast<float>(v));
  }
  for (const Triangle& t : mesh.facets) {
    append(std::uint8_t{3});
    for (const std::uint32_t v : t) append(static_cast<std::int32_t>(v));
  }
  std::ofstream out(file, std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  if (!out) throw_cannot_write(file);
}

TriangleMesh read_ply(const std::filesystem::path& file) {
  return parse_ply(read_whole_file(file), file);
}

TriangleMesh parse_ply(std::string_view content, const std::filesystem::path& file) {
  return Parser(file, content, Accepted::BinarySurfaces).run();
}

TriangleMesh parse_ply_or_points(std::string_view content, const std::filesystem::path& file) {
  return Parser(file, content, Accepted::TextAndPointsToo).run();
}

}  // namespace carpus::case_io
