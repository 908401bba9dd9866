// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether this is built with a sanitizer that has memory and an allocator of its own.
#pragma once

namespace carpus {

/// Under the address and the thread sanitizer: terabytes are mapped, all is many times slower, and
/// a child that is forked while another thread allocates may wait for ever for that thread's lock.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

}  // namespace carpus
