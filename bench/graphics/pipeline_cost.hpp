// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a pair of shaders costs, as the driver's compiler counts it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/graphics/null_device.hpp"

namespace carpus::bench {

struct StageCost {
  std::string stage;         ///< "Vertex Shader", "Fragment Shader"
  std::uint32_t lanes = 0;   ///< invocations that go together
  std::uint64_t cycles = 0;  ///< of one SIMD unit, busy with that many invocations; a loop of
                             ///< unknown turns is guessed at
  std::uint64_t instructions = 0;
  std::uint64_t registers = 0;  ///< vector registers
};

/// @param vertex, fragment  SPIR-V with entry `main`; uniforms are one block at binding 0, textures
/// at 1 to 15, all of set 0
/// @throws std::runtime_error  where they do not compile
std::vector<StageCost> pipeline_cost(const NullDevice& device,
                                     const std::vector<std::uint32_t>& vertex,
                                     const std::vector<std::uint32_t>& fragment);

}  // namespace carpus::bench
