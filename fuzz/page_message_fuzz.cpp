// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as a page's message: refused in words, or a message that comes back from its own text.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "protocol/messages.hpp"
#include "refusals.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto message =
      carpus::protocol::parse_page_message({reinterpret_cast<const char*>(data), size});
  if (!message) {
    if (message.error().empty()) std::abort();
    return 0;
  }
  ++carpus::fuzz::accepted;
  const std::string text = serialize(*message);
  const auto again = carpus::protocol::parse_page_message(text);
  if (!again || serialize(*again) != text) std::abort();
  return 0;
}
