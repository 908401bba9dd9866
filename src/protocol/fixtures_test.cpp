// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The fixtures that page and host share (protocol/fixtures), and seeded mutations of them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "protocol/bodies.hpp"
#include "protocol/messages.hpp"

namespace carpus::protocol {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const fs::path kFixtures = "protocol/fixtures";

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file.is_open()) << path;
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Parses and, where accepted, writes again.
using RoundTrip = std::function<Result<std::string>(std::string_view)>;

template <typename Value, typename Write>
RoundTrip round_trip(Result<Value> (*parse)(std::string_view), Write write) {
  return [parse, write](std::string_view text) -> Result<std::string> {
    const Result<Value> value = parse(text);
    if (!value) return Refusal{value.error()};
    return write(*value);
  };
}

constexpr auto kSerialize = [](const auto& value) { return serialize(value); };

/// By the first words of "direction/name".
const std::map<std::string, RoundTrip>& readers() {
  static const std::map<std::string, RoundTrip> all{
      {"page_to_host/", round_trip(&parse_page_message, kSerialize)},
      {"host_to_page/", round_trip(&parse_host_message, kSerialize)},
      {"http/case_description", round_trip(&parse_case_description, kSerialize)},
      {"http/instrument_list", round_trip(&parse_instrument_list, kSerialize)},
      {"http/procedure_list", round_trip(&parse_procedure_list, kSerialize)},
      {"http/case_pathology", round_trip(&parse_case_pathology, kSerialize)},
      {"http/pathology_wish", round_trip(&parse_pathology_wish, kSerialize)},
      {"http/case_list", round_trip(&parse_case_list, kSerialize)},
      {"http/attempt", round_trip(&parse_attempt, kSerialize)},
      {"http/attempt_list", round_trip(&parse_attempt_list, kSerialize)},
      {"http/quiz_answer_list", round_trip(&parse_quiz_answer_list, kSerialize)},
      {"http/asset_forms", round_trip(&parse_asset_forms, kSerialize)},
      {"http/asset_rating", round_trip(&parse_asset_rating, kSerialize)},
      {"http/picture_truth", round_trip(&parse_picture_truth, kSerialize)},
      {"http/view_debrief", round_trip(&parse_view_debrief, kSerialize)},
      {"http/seen_cartilage", round_trip(&parse_seen_cartilage, kSerialize)},
      {"stored/stored_score",
       round_trip(&parse_stored_score,
                  [](const ScoreReport& report) { return serialize_stored_score(report); })},
      {"stored/stored_asset_answers", round_trip(&parse_stored_asset_answers,
                                                 [](const std::vector<AssetAnswer>& answers) {
                                                   return serialize_stored_asset_answers(answers);
                                                 })},
      {"stored/stored_exercise", round_trip(&parse_stored_exercise,
                                            [](const RunningExercise& exercise) {
                                              return serialize_stored_exercise(exercise);
                                            })},
      {"stored/stored_events",
       round_trip(&parse_stored_events, [](const std::vector<LoggedEvent>& events) {
         return serialize_stored_events(events);
       })}};
  return all;
}

/// The reader with the longest name that the fixture's begins with.
const RoundTrip& reader_of(const std::string& fixture) {
  const RoundTrip* found = nullptr;
  for (const auto& [name, reader] : readers()) {
    if (fixture.starts_with(name)) found = &reader;  // in order: longer ones come later
  }
  if (found == nullptr) throw std::runtime_error(fixture + ": no reader; add it above");
  return *found;
}

/// ("http/attempt_lowest.json", its text) of every fixture, in order.
std::map<std::string, std::string> fixtures(const std::string& kind) {
  std::map<std::string, std::string> texts;
  for (const auto& entry : fs::recursive_directory_iterator(kFixtures / kind)) {
    if (!entry.is_regular_file()) continue;
    texts[fs::relative(entry.path(), kFixtures / kind).string()] = read_file(entry.path());
  }
  return texts;
}

TEST(Fixtures, ValidOnesSurviveReadingAndWriting) {
  const auto all = fixtures("valid");
  for (const auto& [name, text] : all) {
    const Result<std::string> again = reader_of(name)(text);
    ASSERT_TRUE(again.has_value()) << name << ": " << again.error();
    // What is missing is written as null, and so are the lowest.
    const auto absent = name.rfind("_absent.json");
    const std::string& expected =
        absent == std::string::npos ? text : all.at(name.substr(0, absent) + "_lowest.json");
    EXPECT_EQ(Json::parse(*again), Json::parse(expected)) << name;
  }
  EXPECT_GE(all.size(), 45U);
}

TEST(Fixtures, InvalidOnesAreRefusedWithAReason) {
  const auto all = fixtures("invalid");
  for (const auto& [name, text] : all) {
    const Result<std::string> refused = reader_of(name)(text);
    EXPECT_FALSE(refused.has_value()) << name;
    if (!refused) {
      EXPECT_FALSE(refused.error().empty()) << name;
    }
  }
  EXPECT_GE(all.size(), 55U);
}

/// [path, value] sets, [path] removes.
std::string changed(Json root, const Json& change) {
  Json::json_pointer at;
  for (const Json& step : change[0]) {
    if (step.is_string()) {
      at /= step.get<std::string>();
    } else {
      at /= step.get<std::size_t>();
    }
  }
  if (change.size() == 2) {
    root[at] = change[1];
  } else {
    root[at.parent_pointer()].erase(at.back());
  }
  return root.dump();
}

TEST(Fixtures, EveryChangeThatBreaksOneRuleIsRefused) {
  std::size_t count = 0;
  const Json all = Json::parse(read_file(kFixtures / "refused_changes.json"));
  for (const auto& [name, changes] : all.items()) {
    const Json root = Json::parse(read_file(kFixtures / "valid" / name));
    for (const Json& change : changes) {
      EXPECT_FALSE(reader_of(name)(changed(root, change)).has_value())
          << name << " with " << change.dump();
      ++count;
    }
  }
  EXPECT_GE(count, 1000U);
}

/// What is accepted must be in range: written, it is accepted again and says the same.
void expect_harmless(const std::string& name, const std::string& text) {
  const RoundTrip& read = reader_of(name);
  const Result<std::string> written = read(text);
  if (!written) {
    EXPECT_FALSE(written.error().empty()) << text;
    return;
  }
  const Result<std::string> again = read(*written);
  ASSERT_TRUE(again.has_value()) << name << ": " << text << ": " << again.error();
  EXPECT_EQ(*again, *written) << text;
}

TEST(Mutations, EveryPrefixAndEverySingleByteChangeOfAMessageIsAnsweredWithoutHarm) {
  const std::string name = "page_to_host/hand.json";
  const std::string text = read_file(kFixtures / "valid" / name);
  for (std::size_t length = 0; length < text.size(); ++length) {
    EXPECT_FALSE(reader_of(name)(text.substr(0, length)).has_value()) << length;
  }
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (int byte = 0; byte < 256; ++byte) {
      std::string other = text;
      other[i] = static_cast<char>(byte);
      expect_harmless(name, other);
    }
  }
}

/// A few bytes changed, left out, doubled, or a piece of another place put in.
std::string mutated(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  const std::size_t steps = 1 + below(4);
  for (std::size_t step = 0; step < steps && !text.empty(); ++step) {
    const std::size_t at = below(text.size());
    const std::size_t length = std::min(1 + below(12), text.size() - at);
    constexpr std::string_view kTelling = "{}[]\",:0123456789-.eE\\ntrufals \x01\xC3\xFF";
    switch (below(5)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text[at] = kTelling[below(kTelling.size())];
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(at, text.substr(at, length));
        break;
      default:
        text.insert(below(text.size()), text.substr(at, length));
    }
  }
  return text;
}

TEST(Mutations, OfEveryFixtureAreAnsweredWithoutHarm) {
  for (const char* kind : {"valid", "invalid"}) {
    for (const auto& [name, text] : fixtures(kind)) {
      // Long texts are refused long before their end: fewer of them tell as much.
      std::mt19937 random(20260131);
      const std::size_t rounds = 40 + 200'000 / (text.size() + 200);
      for (std::size_t round = 0; round < rounds; ++round) {
        expect_harmless(name, mutated(text, random));
        if (::testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

}  // namespace
}  // namespace carpus::protocol
