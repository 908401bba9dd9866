// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a process that decodes foreign bytes may ask of the system: memory, to end, and to write to
// the one pipe that it was given.
#pragma once

namespace carpus::case_io {

/// From here on every other system call ends this process (or, for those that libraries try in
/// passing, such as opening a file, fails). Cannot be taken back.
/// @return false where the system does not know filters.
[[nodiscard]] bool allow_decoding_only() noexcept;

}  // namespace carpus::case_io
