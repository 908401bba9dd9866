// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether there is memory for what a header promises, before it is asked for.
#pragma once

#include <cstdint>
#include <string>

namespace carpus::case_io {

/// What can be had now: free memory of the machine, and of this process where it is limited.
[[nodiscard]] std::uint64_t memory_room();

/// @throws IoError naming the file, both sizes and what to do, where `bytes` are not to be had.
void require_memory(std::uint64_t bytes, const std::string& file);

/// What this process has mapped; a limit on memory counts all of it.
[[nodiscard]] std::uint64_t mapped_bytes() noexcept;

}  // namespace carpus::case_io
