// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as what comes over the wire, from the host and from the arm: no frame, or one that
// comes back from its own bytes. The same again with the checksum that a forger would make.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "firmware/core/frame_decoder.hpp"
#include "refusals.hpp"

namespace {

using namespace carpus::firmware;

template <typename Decoder>
void take(const Decoder& decoder) {
  int known = 0;
  visit_frames([&](const char*, auto frame) {
    if (decoder.kind() != kind_of(frame)) return;
    ++known;
    if (!decoder.read_frame(frame)) return;
    ++carpus::fuzz::accepted;
    std::uint8_t bytes[kMaxFrameBytes];
    const std::uint8_t length = encode_frame(frame, decoder.sequence(), bytes);
    if (std::memcmp(bytes + 1, decoder.payload() - 2, static_cast<std::size_t>(length - 1)) != 0) {
      std::abort();
    }
  });
  if (known != 1) std::abort();
}

template <typename Decoder>
void run(const std::uint8_t* data, std::size_t size) {
  Decoder decoder;
  for (std::size_t i = 0; i < size; ++i) {
    decoder.push(data[i]);
    while (decoder.next()) take(decoder);
  }
}

/// What follows is one frame of the kind that the first byte chooses, with a right checksum.
template <typename Decoder>
void run_forged(const std::uint8_t* data, std::size_t size, std::uint8_t (*payload)(std::uint8_t)) {
  if (size < 2) return;
  const std::uint8_t length = payload(data[0]);
  if (length > kMaxFrameBytes - kFrameOverhead || size < std::size_t{2} + length) return;
  std::uint8_t frame[kMaxFrameBytes] = {kSync};
  std::memcpy(frame + 1, data, std::size_t{2} + length);
  write(frame_crc(frame + 1, static_cast<std::uint8_t>(length + 2)), frame + 3 + length);
  run<Decoder>(frame, std::size_t{length} + kFrameOverhead);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  run<DeviceDecoder>(data, size);
  run<HostDecoder>(data, size);
  run_forged<DeviceDecoder>(data, size, host_to_device_payload_bytes);
  run_forged<HostDecoder>(data, size, device_to_host_payload_bytes);
  return 0;
}
