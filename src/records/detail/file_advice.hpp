// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What a person can do about a file that the system refuses.
#pragma once

#include <cerrno>
#include <string>

namespace carpus::records::detail {

[[nodiscard]] inline std::string advice(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "free some space and try again";
    case ENOENT:
      return "create its folder first";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a place that you may write to";
    default:
      return "choose another place";
  }
}

}  // namespace carpus::records::detail
