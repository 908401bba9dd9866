// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Surfaces and point sets in the formats that other programs write: PLY, STL, OBJ, OFF, XYZ, CSV.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "geometry/predicates.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::case_io {

/// Reads by the file's extension: .ply (as parse_ply_or_points), .stl (binary or text; equal
/// corners become one vertex), .obj (v and f lines; others are skipped), .off, .xyz (three numbers
/// a line, further columns are skipped; no facets). Polygons are cut into triangles from their
/// first corner. Nothing is believed before it is checked; no memory is set aside for what a header
/// promises.
/// @throws IoError naming the file, the line of a text file, and what is wrong.
[[nodiscard]] TriangleMesh read_surface(const std::filesystem::path& file);

/// The same of bytes at hand; `file` names them and says by its extension what they are.
[[nodiscard]] TriangleMesh parse_surface(std::string_view content,
                                         const std::filesystem::path& file);

/// Writes by the file's extension: .ply, .obj and .off keep every bit of a coordinate; .stl is
/// binary and holds single precision, as the format does.
/// @param normals  of the vertices, for .ply and .obj; may be empty
/// @throws IoError where the file cannot be written whole or the format is not known.
void write_surface(const std::filesystem::path& file,
                   const TriangleMesh& mesh,
                   std::span<const Vec3> normals = {});

/// Writes faces of any number of corners, to .obj or .off only.
/// @param faces  indices of vertices, counter-clockwise from outside.
/// @throws IoError as write_surface.
void write_polygons(const std::filesystem::path& file,
                    std::span<const Vec3> vertices,
                    std::span<const std::vector<std::uint32_t>> faces);

/// Two numbers a line, between them a comma, a semicolon or blanks; the first line may hold names,
/// as may further columns.
/// @throws IoError as read_surface, and where a line holds three numbers: points in space.
[[nodiscard]] std::vector<Vec2> read_planar_points(const std::filesystem::path& file);

/// The same of bytes at hand.
[[nodiscard]] std::vector<Vec2> parse_planar_points(std::string_view content,
                                                    const std::filesystem::path& file);

}  // namespace carpus::case_io
