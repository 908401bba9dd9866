// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The generated codec against the fixtures, which the definition's own reader made in another
// language, bit by bit.
#include "firmware/core/wire.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "firmware/core/frame_decoder.hpp"

namespace carpus::firmware {
namespace {

using Json = nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

Json fixtures(const std::string& name) {
  std::ifstream file("protocol/device_fixtures/" + name);
  return Json::parse(file);
}

Bytes bytes_of(const std::string& hex) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

template <typename T>
void set(T& value, const Json& from) {
  if constexpr (std::is_class_v<T>) {
    visit_parts(value, [&](const char* name, auto& part) { set(part, from.at(name)); });
  } else {
    value = static_cast<T>(from.get<long long>());
  }
}

template <typename T>
Json json_of(T& value) {
  if constexpr (std::is_class_v<T>) {
    Json out = Json::object();
    visit_parts(value, [&](const char* name, auto& part) { out[name] = json_of(part); });
    return out;
  } else {
    return static_cast<long long>(value);
  }
}

/// Sets a frame's fields from JSON, or shows them.
struct Setter {
  const Json& fields;
  template <typename T>
  void operator()(const char* name, T& value) const {
    set(value, fields.at(name));
  }
  template <typename T>
  void operator()(const char* name, T* values, int count) const {
    for (int i = 0; i < count; ++i) set(values[i], fields.at(name).at(static_cast<unsigned>(i)));
  }
};
struct Shower {
  Json& fields;
  template <typename T>
  void operator()(const char* name, T& value) const {
    fields[name] = json_of(value);
  }
  template <typename T>
  void operator()(const char* name, T* values, int count) const {
    for (int i = 0; i < count; ++i) fields[name].push_back(json_of(values[i]));
  }
};

/// Frames of both directions that stand in these bytes, as JSON; those with a field out of its
/// range are counted apart.
struct Found {
  std::vector<Json> frames;
  int out_of_range = 0;
};
template <typename Decoder>
void find(const Bytes& bytes, Found& found) {
  Decoder decoder;
  for (const std::uint8_t byte : bytes) {
    decoder.push(byte);
    while (decoder.next()) {
      visit_frames([&](const char* name, auto frame) {
        if (decoder.kind() != kind_of(frame)) return;
        if (!decoder.read_frame(frame)) {
          ++found.out_of_range;
          return;
        }
        Json fields = Json::object();
        visit_fields(frame, Shower{fields});
        found.frames.push_back(
            {{"frame", name}, {"sequence", decoder.sequence()}, {"fields", fields}});
      });
    }
  }
}
Found found_in(const Bytes& bytes) {
  Found found;
  find<DeviceDecoder>(bytes, found);
  find<HostDecoder>(bytes, found);
  return found;
}

TEST(Wire, ReadsAndWritesEveryGoldenFrame) {
  int seen = 0;
  for (const Json& golden : fixtures("valid.json")) {
    SCOPED_TRACE(golden.at("name").get<std::string>());
    const Bytes bytes = bytes_of(golden.at("hex"));
    const Found found = found_in(bytes);
    ASSERT_EQ(found.frames.size(), 1U);
    EXPECT_EQ(found.frames[0].at("frame"), golden.at("frame"));
    EXPECT_EQ(found.frames[0].at("sequence"), golden.at("sequence"));
    EXPECT_EQ(found.frames[0].at("fields"), golden.at("fields"));
    visit_frames([&](const char* name, auto frame) {
      if (name != golden.at("frame")) return;
      visit_fields(frame, Setter{golden.at("fields")});
      Bytes written(kMaxFrameBytes);
      written.resize(encode_frame(frame, golden.at("sequence"), written.data()));
      EXPECT_EQ(written, bytes);
      ++seen;
    });
  }
  EXPECT_EQ(seen, 22) << "two of each of eleven frames";
}

TEST(Wire, RefusesEveryInvalidFrameForItsReason) {
  int refused = 0;
  for (const Json& invalid : fixtures("invalid.json")) {
    SCOPED_TRACE(invalid.at("name").get<std::string>());
    const Found found = found_in(bytes_of(invalid.at("hex")));
    EXPECT_TRUE(found.frames.empty());
    EXPECT_EQ(found.out_of_range > 0, invalid.at("why") == "range");
    ++refused;
  }
  EXPECT_GT(refused, 60);
}

TEST(Wire, AStopIsElevenBytes) {
  std::uint8_t bytes[kMaxFrameBytes];
  EXPECT_EQ(encode_frame(Stop{}, 0, bytes), 11);
}

}  // namespace
}  // namespace carpus::firmware
