// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The arm put together: every printed part, and what is bought, at a pose of its tip. What is drawn
// is what is checked.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "arm/portal_tool.hpp"
#include "geometry/vec3.hpp"
#include "hardware/workshop/numbers.hpp"
#include "hardware/workshop/solids.hpp"

namespace carpus::hardware {

enum class Material : std::uint8_t {
  Frame,   ///< printed: plate, blocks, sockets
  Moving,  ///< printed: legs, platform, gimbal
  Accent,  ///< printed: what the hand holds, the wrist
  Drive,   ///< printed: mounts
  Steel,
  Carbon,
  Servo,
  Brass,
  Board,
  Wood,
  Rubber,
  Red,
};

/// What moves as one. Only different ones are asked whether they keep clear.
enum class Group : std::uint8_t {
  Base,
  Leg0,
  Leg1,
  Leg2,
  Fork0,
  Fork1,
  Fork2,
  Rod0,
  Rod1,
  Rod2,
  Rod3,
  Rod4,
  Rod5,
  Platform,
  Ring,
  Carrier,
  Tool,
};

struct Piece {
  std::string name;
  Group group{};
  Material material{};
  TriangleMesh mesh;  ///< in the arm's frame
  int leg = -1;       ///< that it belongs to, with its rods and drive
};

enum class Drive : std::uint8_t { A, B };

/// The printed parts' meshes by name.
using Parts = std::map<std::string, TriangleMesh, std::less<>>;
/// @throws IoError where a part is missing.
[[nodiscard]] Parts read_parts(const std::filesystem::path& hardware);

struct AssemblyOptions {
  Drive drive = Drive::A;
  Vec3 tip{0, 0, -130};
  bool has_tool = true;
  bool is_scope = false;
  /// Where in its slot a leg's dog is: -1 to 1.
  double dog = 0;
};

/// The tool leans no farther than its gimbal goes, 35 degrees, and has room above the shell.
[[nodiscard]] bool tool_may_be_at(const Vec3& tip);

/// @throws InvalidInput where the tip is out of reach.
[[nodiscard]] std::vector<Piece> assemble(const Numbers& numbers,
                                          const Parts& parts,
                                          const AssemblyOptions& options);

}  // namespace carpus::hardware
