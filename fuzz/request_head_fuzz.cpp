// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as a request: refused in words, or read so that nobody could read them otherwise.
#include "server/request_head.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <variant>

#include "refusals.hpp"

namespace {

using carpus::server::RequestField;
using carpus::server::RequestHead;
using carpus::server::RequestProblem;

void demand(bool holds) {
  if (!holds) std::abort();
}

void check(const RequestHead& head) {
  demand(head.method == "GET" || head.method == "HEAD");
  demand(head.target.starts_with('/') && !head.authority.empty());
  std::size_t hosts = 0;
  for (const RequestField& field : head.fields) {
    hosts += field.name == "host" ? 1 : 0;
    demand(!field.name.empty() && field.name != "transfer-encoding");
    for (const char c : field.name + field.value) {
      demand(c == '\t' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F));
    }
  }
  demand(hosts == 1);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const carpus::server::HeadEnd found = carpus::server::find_head_end(bytes);
  demand(found.end <= size && (found.end == 0 || !found.problem));
  // In two pieces it ends at the same place.
  const std::size_t half = size / 2;
  if (carpus::server::find_head_end(bytes.substr(0, half)).end == 0) {
    demand(carpus::server::find_head_end(bytes, half).end == found.end ||
           carpus::server::find_head_end(bytes.substr(0, half)).problem.has_value());
  }
  const auto parsed =
      carpus::server::parse_request_head(std::string_view(bytes).substr(0, found.end));
  if (const auto* problem = std::get_if<RequestProblem>(&parsed)) {
    demand(problem->status >= 400 && problem->status < 600 && !problem->reason.empty());
  } else if (found.end > 0) {
    ++carpus::fuzz::accepted;
    check(*std::get_if<RequestHead>(&parsed));
  }
  return 0;
}
