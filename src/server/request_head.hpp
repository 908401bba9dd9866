// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The head of an HTTP request, read strictly: what two readers could take for different requests
// is refused (RFC 9112). Stricter than a general server must be: two addresses alone take bodies,
// of a length that is said once and in front, so chunks and trailers have no place to hide in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace carpus::server {

/// A longer head is refused (431).
inline constexpr std::size_t kMaxHeadBytes = 16384;
/// As are more fields than these.
inline constexpr std::size_t kMaxHeadFields = 100;

/// Below this address things are changed by HTTP (new_case_desk.hpp): POST and DELETE, and PUT,
/// which has a body.
inline constexpr std::string_view kNewCasePath = "/api/new_case";
inline constexpr std::string_view kNewCaseRunPath = "/api/new_case/run";
inline constexpr std::string_view kNewCaseMadePath = "/api/new_case/made";
inline constexpr std::string_view kNewCaseFilePath = "/api/new_case/file";
/// And at these, by PUT alone (asset_desk.hpp, pathology_desk.hpp). Nowhere else.
inline constexpr std::string_view kAssetPath = "/api/asset";
inline constexpr std::string_view kPathologyPath = "/api/pathology";
/// A body that claims to be longer is refused before a byte of it is read.
inline constexpr std::uint64_t kMaxBodyBytes = std::uint64_t{1} << 30U;

struct RequestField {
  std::string name;   ///< lower case
  std::string value;  ///< without white space at its ends
};

struct RequestHead {
  std::string method;  ///< "GET" or "HEAD"; at the addresses above also "POST", "PUT" and "DELETE"
  std::string target;  ///< path and query, "/a?b", of the absolute form too
  std::string authority;  ///< whom the request is for: the one Host field, "127.0.0.1:8080"
  bool is_http_1_1 = true;
  bool keep_alive = true;
  std::uint64_t body_bytes = 0;  ///< that follow the head; of a PUT alone, which has some
  std::vector<RequestField> fields;

  /// The value of the first field of this name (lower case); nothing where there is none.
  [[nodiscard]] std::optional<std::string_view> find(std::string_view name) const;
};

/// Why a request is refused.
struct RequestProblem {
  unsigned status = 400;
  std::string reason;  ///< a sentence
};

/// Where the head ends in what has arrived (behind its empty line); 0 while it has not.
struct HeadEnd {
  std::size_t end = 0;
  std::optional<RequestProblem> problem;  ///< nothing that may follow could mend it
};

/// @param bytes  of which the first `scanned` were looked at before.
[[nodiscard]] HeadEnd find_head_end(std::string_view bytes, std::size_t scanned = 0);

/// @param head  with its empty line, as found by find_head_end.
[[nodiscard]] std::variant<RequestHead, RequestProblem> parse_request_head(std::string_view head);

}  // namespace carpus::server
