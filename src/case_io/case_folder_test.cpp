// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/case_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <exception>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "case_io/pathology_file.hpp"
#include "case_io/ply.hpp"
#include "case_io/small_case_test_support.hpp"
#include "core/error.hpp"
#include "core/is_sanitized.hpp"
#include "core/parallel.hpp"

namespace carpus::case_io {
namespace {

namespace fs = std::filesystem;
using test::small_case;
using test::small_table;
using ::testing::AllOf;
using ::testing::HasSubstr;

class CaseFolder : public ::testing::Test {
 protected:
  CaseFolder()
      : folder_(fs::temp_directory_path() /
                ("carpus_case_" + std::to_string(::getpid()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~CaseFolder() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path target() const { return folder_ / "wrist"; }
  [[nodiscard]] const fs::path& parent() const { return folder_; }
  /// Entries of the parent folder: the case and whatever was left behind.
  [[nodiscard]] std::ptrdiff_t entries() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }
  void replace_in_json(const std::string& from, const std::string& to) const {
    std::ifstream in(target() / "case.json");
    std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    std::ofstream(target() / "case.json") << text;
  }

 private:
  fs::path folder_;
};

template <typename E>
std::string error_of(const fs::path& folder) {
  try {
    (void)read_case(folder);
  } catch (const E& error) {
    return error.what();
  } catch (const std::exception& error) {
    return std::string("another kind of error: ") + error.what();
  }
  return "no error";
}

template <typename T>
void expect_same_grid(const Grid<T>& a, const Grid<T>& b) {
  EXPECT_EQ(a.geometry(), b.geometry());
  EXPECT_TRUE(
      std::equal(a.values().begin(), a.values().end(), b.values().begin(), b.values().end()));
}

void expect_same_case(const cases::CaseData& a, const cases::CaseData& b) {
  EXPECT_EQ(a.pseudonym, b.pseudonym);
  EXPECT_EQ(a.side, b.side);
  EXPECT_EQ(a.provenance.simulated, b.provenance.simulated);
  EXPECT_EQ(a.provenance.source, b.provenance.source);
  EXPECT_EQ(a.provenance.made_at, b.provenance.made_at);
  EXPECT_EQ(a.provenance.conventions, b.provenance.conventions);
  EXPECT_EQ(a.provenance.version_of, b.provenance.version_of);
  EXPECT_EQ(a.wrist_from_patient, b.wrist_from_patient);
  EXPECT_EQ(a.scaphoid.longest_line.distal, b.scaphoid.longest_line.distal);
  EXPECT_EQ(a.scaphoid.central_radius_mm, b.scaphoid.central_radius_mm);
  EXPECT_EQ(a.scaphoid.waist, b.scaphoid.waist);
  EXPECT_TRUE(a.hand_motion == b.hand_motion);
  expect_same_grid(a.ct, b.ct);
  expect_same_grid(a.labels, b.labels);
  EXPECT_EQ(a.skin.vertices, b.skin.vertices);
  EXPECT_EQ(a.skin.facets, b.skin.facets);
  ASSERT_EQ(a.bones.size(), b.bones.size());
  for (std::size_t i = 0; i < a.bones.size(); ++i) {
    EXPECT_EQ(a.bones[i].bone, b.bones[i].bone);
    EXPECT_EQ(a.bones[i].part, b.bones[i].part);
    EXPECT_EQ(a.bones[i].label, b.bones[i].label);
    EXPECT_EQ(a.bones[i].surface.vertices, b.bones[i].surface.vertices);
    EXPECT_EQ(a.bones[i].surface.facets, b.bones[i].surface.facets);
    EXPECT_EQ(a.bones[i].patient_from_bone, b.bones[i].patient_from_bone);
    expect_same_grid(a.bones[i].distance_field, b.bones[i].distance_field);
    EXPECT_EQ(a.bones[i].hull.vertices, b.bones[i].hull.vertices);
    EXPECT_EQ(a.bones[i].hull.facets, b.bones[i].hull.facets);
    EXPECT_EQ(a.bones[i].hull.neighbours, b.bones[i].hull.neighbours);
    EXPECT_EQ(a.bones[i].hull.input_indices, b.bones[i].hull.input_indices);
  }
}

TEST_F(CaseFolder, GivesBackWhatWasWrittenBitForBit) {
  const cases::CaseData data = small_case();
  write_case(data, target());
  const cases::CaseData again = read_case(target());
  expect_same_case(data, again);
  EXPECT_EQ(entries(), 1);
  for (const cases::Bone& bone : again.bones) {
    ASSERT_EQ(bone.hull.planes.size(), 8U);
    for (std::size_t f = 0; f < 8; ++f) {
      EXPECT_NEAR(length(bone.hull.planes[f].normal), 1.0, 1e-15);
      for (const Vec3& v : bone.hull.vertices) {
        EXPECT_LE(dot(bone.hull.planes[f].normal, v), bone.hull.planes[f].offset);
      }
    }
  }
}

TEST_F(CaseFolder, GivesBackStructuresBitForBitAndSaysThatTheyWereGenerated) {
  cases::CaseData data = small_case();
  data.structures = test::small_structures();
  write_case(data, target());
  EXPECT_EQ(read_case(target()).structures, data.structures);
  for (const char* name : {"case.json", "structures.json"}) {
    std::ifstream in(target() / name);
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    EXPECT_THAT(text, HasSubstr("\"generated\":")) << name;
  }
}

TEST_F(CaseFolder, TakesOtherStructuresByThreeFilesAlone) {
  cases::CaseData data = small_case();
  write_case(data, target());
  EXPECT_TRUE(read_case(target()).structures.empty());
  data.structures = test::small_structures();
  for (const auto& [name, content] : structure_files(data)) {
    std::ofstream(target() / name, std::ios::binary) << content;
  }
  const cases::CaseData again = read_case(target());
  EXPECT_EQ(again.structures, data.structures);
  const auto bytes_of = [](const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  };
  const fs::path whole = target().parent_path() / "whole";
  write_case(data, whole);
  for (const char* name : {"case.json", "bones.glb", "structures.json"}) {
    EXPECT_EQ(bytes_of(target() / name), bytes_of(whole / name)) << name;
  }
}

TEST_F(CaseFolder, GivesBackThePreparedPathologyAndRefusesADamagedOneByThatFilesName) {
  cases::CaseData data = small_case();
  write_case(data, target());
  EXPECT_FALSE(read_case(target()).pathology);
  data.pathology = cases::PreparedPathology{{3, 0, 2}, 7, false};
  write_case(data, target(), Overwrite::Replace);
  EXPECT_EQ(read_case(target()).pathology, data.pathology);
  std::ofstream(target() / kPathologyFile) << "{}";
  EXPECT_THAT(error_of<InvalidInput>(target()), HasSubstr("pathology.json: pathology: format"));
}

TEST_F(CaseFolder, OfAnOlderProgramHasNoStructures) {
  write_case(small_case(), target());
  EXPECT_FALSE(fs::exists(target() / "structures.json"));
  EXPECT_TRUE(read_case(target()).structures.empty());
}

TEST_F(CaseFolder, WhoseStructuresAreLostIsRefused) {
  cases::CaseData data = small_case();
  data.structures = test::small_structures();
  write_case(data, target());
  fs::remove(target() / "structures.json");
  EXPECT_THAT(error_of<IoError>(target()),
              AllOf(HasSubstr("structures.json: is not there"), HasSubstr("make the case again")));
}

TEST_F(CaseFolder, WithDamagedStructuresIsRefusedByThatFilesName) {
  cases::CaseData data = small_case();
  data.structures = test::small_structures();
  write_case(data, target());
  const fs::path file = target() / "structures.json";
  std::ifstream in(file);
  const std::string whole{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const auto refused_with = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    std::ofstream(file) << text;
    EXPECT_THAT(error_of<IoError>(target()), HasSubstr("structures.json")) << to;
  };
  refused_with("carpus structures", "something else");
  refused_with("\"tendon\"", "\"bone\"");
  refused_with("\"ulna\"", "\"scaphoid\"");
  refused_with("0.75]", "1.75]");
  refused_with("[1.0,2.0,3.0,0.5],", "");
  refused_with("[-4.0,", "[null,");
  refused_with(whole.substr(whole.size() / 2), "");
  std::string newer = whole;
  newer.replace(newer.find("\"schema_version\":1"), 18, "\"schema_version\":2");
  std::ofstream(file) << newer;
  EXPECT_THAT(error_of<SchemaError>(target()), HasSubstr("structures.json"));
}

TEST_F(CaseFolder, OfAnOlderProgramHasNoTableOfHandMotion) {
  cases::CaseData data = small_case();
  data.hand_motion = {};
  write_case(data, target());
  EXPECT_FALSE(fs::exists(target() / "hand_motion.json"));
  EXPECT_TRUE(read_case(target()).hand_motion.is_empty());
}

TEST_F(CaseFolder, WithADamagedTableOfHandMotionIsRefusedByThatFilesName) {
  write_case(small_case(), target());
  const fs::path file = target() / "hand_motion.json";
  std::ifstream in(file);
  const std::string whole{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const auto refused_with = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    std::ofstream(file) << text;
    EXPECT_THAT(error_of<IoError>(target()),
                AllOf(HasSubstr("hand_motion.json"), HasSubstr("made anew")))
        << to;
  };
  refused_with("carpus hand motion", "something else");
  refused_with("\"nodes\":[[", "\"nodes\":[");
  refused_with("[[1.0,", "[[0.5,");  // no unit quaternion
  refused_with("[[1.0,", "[[null,");
  refused_with("[-0.3333333333333333,1.1]", "[1.1,-0.3333333333333333]");  // an axis that falls
  refused_with("[-0.3333333333333333,1.1],\"radial", "[1.1],\"radial");
  refused_with("1.5],\"shift_mm\":[[0.1,0.2,", "1.5],\"shift_mm\":[[0.1,");
  refused_with(whole.substr(whole.size() / 2), "");
  // Right in form, and no wrist's motion.
  refused_with("\"traction_n\":[0.0,100.0]", "\"traction_n\":[0.0,90000.0]");
  refused_with("\"shift_mm\":[[0.1,", "\"shift_mm\":[[99000.1,");
  refused_with(",3.0,0.3]", ",3000.0,0.3]");
  std::string newer = whole;
  newer.replace(newer.find("\"schema_version\":1"), 18, "\"schema_version\":2");
  std::ofstream(file) << newer;
  EXPECT_THAT(error_of<SchemaError>(target()), HasSubstr("hand_motion.json"));
}

TEST_F(CaseFolder, IsReplacedOnlyOnDemand) {
  cases::CaseData data = small_case();
  write_case(data, target());
  data.pseudonym = "another";
  EXPECT_THROW(write_case(data, target()), IoError);
  EXPECT_EQ(read_case(target()).pseudonym, small_case().pseudonym);
  write_case(data, target(), Overwrite::Replace);
  EXPECT_EQ(read_case(target()).pseudonym, "another");
  EXPECT_EQ(entries(), 1);
}

TEST_F(CaseFolder, AFullDiskLeavesTheOldCaseAndNothingElse) {
  cases::CaseData data = small_case();
  write_case(data, target());
  data.pseudonym = "another";
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  std::uintmax_t largest = 0;
  for (const auto& entry : fs::recursive_directory_iterator(target())) {
    if (entry.is_regular_file()) largest = std::max(largest, entry.file_size());
  }
  // From too little for the first surface to a few bytes too little for the largest file.
  for (const std::uintmax_t limit : {std::uintmax_t{100}, std::uintmax_t{400}, std::uintmax_t{900},
                                     largest / 2, largest - 300, largest - 1}) {
    rlimit small = before;
    small.rlim_cur = limit;
    setrlimit(RLIMIT_FSIZE, &small);
    std::string message = "no error";
    try {
      write_case(data, target(), Overwrite::Replace);
    } catch (const IoError& error) {
      message = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_THAT(message, AllOf(HasSubstr("could not be written whole"), HasSubstr("make room")))
        << limit;
    expect_same_case(small_case(), read_case(target()));
    EXPECT_EQ(entries(), 1) << limit;
  }
}

/// A scan that packs well lies there unpacked for a moment, and is then far larger than any file of
/// the case: a disk may have room for the case and none for that. What fails on one thread must
/// reach the caller from any other, too.
TEST_F(CaseFolder, AFullDiskWhileAVolumeLiesUnpackedLeavesTheOldCaseAndNothingElse) {
  install_parallel_executor([](std::size_t count, std::size_t,
                               const std::function<void(std::size_t, std::size_t)>& body) {
    std::vector<std::exception_ptr> failures(count);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < count; ++i) {
      threads.emplace_back([&, i] {
        try {
          body(i, i + 1);
        } catch (...) {
          failures[i] = std::current_exception();
        }
      });
      if (kIsSanitized) threads.back().join();  // what is read back is read by a forked child
    }
    for (std::thread& thread : threads) {
      if (thread.joinable()) thread.join();
    }
    for (const std::exception_ptr& failure : failures) {
      if (failure) std::rethrow_exception(failure);
    }
  });
  cases::CaseData data = small_case();
  GridGeometry g = data.ct.geometry();
  g.size = {64, 60, 50};
  data.ct = Grid<std::int16_t>(g, std::int16_t{-1000});
  data.labels = Grid<std::uint8_t>(g);
  write_case(data, target());
  const cases::CaseData old = data;
  data.pseudonym = "another";
  std::uintmax_t largest = 0;
  for (const auto& entry : fs::recursive_directory_iterator(target())) {
    if (entry.is_regular_file()) largest = std::max(largest, entry.file_size());
  }
  constexpr std::uintmax_t kHeader = 352;
  const std::uintmax_t labels = kHeader + g.voxel_count();
  const std::uintmax_t ct = kHeader + sizeof(std::int16_t) * g.voxel_count();
  ASSERT_LT(largest, labels);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto message_with_room_for = [&](std::uintmax_t bytes) -> std::string {
    rlimit small = before;
    small.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &small);
    std::string message = "no error";
    try {
      write_case(data, target(), Overwrite::Replace);
    } catch (const IoError& error) {
      message = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &before);
    return message;
  };
  for (const std::uintmax_t bytes : {largest, labels - 1, labels, ct / 2, ct - 1}) {
    SCOPED_TRACE(std::to_string(bytes) + " of " + std::to_string(ct) + " bytes");
    EXPECT_THAT(message_with_room_for(bytes),
                AllOf(HasSubstr("could not be written whole"), HasSubstr("make room")));
    expect_same_case(old, read_case(target()));
    EXPECT_EQ(entries(), 1);
  }
  EXPECT_EQ(message_with_room_for(ct), "no error");
  expect_same_case(data, read_case(target()));
  EXPECT_EQ(entries(), 1);
  for (const auto& entry : fs::recursive_directory_iterator(target())) {
    EXPECT_NE(entry.path().extension(), ".nii") << "the unpacked one is no file of the case";
  }
  install_parallel_executor({});
}

TEST_F(CaseFolder, OfANewerVersionIsRefusedByName) {
  write_case(small_case(), target());
  replace_in_json("\"schema_version\": 2", "\"schema_version\": 3");
  EXPECT_THAT(error_of<SchemaError>(target()),
              AllOf(HasSubstr("version 3"), HasSubstr("up to 2"), HasSubstr("update carpus")));
}

TEST_F(CaseFolder, OfTheVersionBeforeStillOpensAndItsPostureIsIgnored) {
  write_case(small_case(), target());
  replace_in_json("\"schema_version\": 2",
                  "\"operative_posture\": {\"flexion_from_scan_rad\": 0.7}, "
                  "\"schema_version\": 1");
  EXPECT_EQ(read_case(target()).bones.size(), small_case().bones.size());
}

TEST_F(CaseFolder, MissingOrDamagedFilesAreNamed) {
  EXPECT_THAT(error_of<IoError>(parent() / "none"), HasSubstr("case.json"));
  const auto fresh = [&] { write_case(small_case(), target(), Overwrite::Replace); };
  for (const char* name : {"ct.nii.gz", "labels.nii.gz", "fields/lunate.nrrd", "bones/lunate.ply",
                           "hulls/scaphoid_distal.ply"}) {
    fresh();
    fs::resize_file(target() / name, fs::file_size(target() / name) / 2);
    EXPECT_THAT(error_of<IoError>(target()), HasSubstr(name)) << "cut";
    fs::remove(target() / name);
    EXPECT_THAT(error_of<IoError>(target()), HasSubstr(name)) << "missing";
  }
  fresh();
  fs::copy_file(target() / "hulls" / "lunate.ply", target() / "hulls" / "scaphoid_distal.ply",
                fs::copy_options::overwrite_existing);
  EXPECT_THAT(error_of<IoError>(target()), HasSubstr("no convex hull of bones/scaphoid_distal"));
}

TEST_F(CaseFolder, DevicesAndPipesInItAreRefusedWithoutWaiting) {
  for (const char* name :
       {"case.json", "hand_motion.json", "ct.nii.gz", "labels.nii.gz", "skin.ply",
        "fields/lunate.nrrd", "bones/lunate.ply", "hulls/lunate.ply"}) {
    write_case(small_case(), target(), Overwrite::Replace);
    fs::remove(target() / name);
    ASSERT_EQ(::mkfifo((target() / name).c_str(), 0600), 0);
    EXPECT_THAT(error_of<IoError>(target()), AllOf(HasSubstr(name), HasSubstr("no regular file")));
    fs::remove(target() / name);
    fs::create_symlink("/dev/zero", target() / name);
    EXPECT_THAT(error_of<IoError>(target()), AllOf(HasSubstr(name), HasSubstr("no regular file")));
  }
}

TEST_F(CaseFolder, JsonThatLiesIsRefused) {
  const auto fresh = [&] { write_case(small_case(), target(), Overwrite::Replace); };
  for (const auto& [from, to] :
       {std::pair{"\"lunate\"", "\"../../etc\""}, std::pair{"\"right\"", "\"middle\""},
        std::pair{"\"carpus case\"", "\"recipe\""}, std::pair{"\"label\": 4", "\"label\": \"4\""},
        std::pair{"\"label\": 4", "\"label\": 260"}, std::pair{"\"label\": 4", "\"label\": 5"},
        std::pair{"\"label\": 4", "\"label\": 1e99"},
        std::pair{"\"schema_version\": 2", "\"schema_version\": 1e99"},
        std::pair{"\"schema_version\": 2", "\"schema_version\": -1"},
        std::pair{"\"central_radius_mm\": 3.25", "\"central_radius_mm\": -3.25"},
        std::pair{"-12.1", "-1e300"}, std::pair{"wrist \\\"7", "wrist \\u001b[31m"},
        std::pair{"\"spacing_mm\"", "\"spacing\""}, std::pair{"\"rotation\"", "\"rotations\""}}) {
    fresh();
    replace_in_json(from, to);
    EXPECT_THAT(error_of<IoError>(target()), HasSubstr("case.json")) << from;
  }
  cases::CaseData twice = small_case();
  twice.bones.push_back(twice.bones.front());
  write_case(twice, target(), Overwrite::Replace);
  EXPECT_THAT(error_of<IoError>(target()), HasSubstr("a bone is there twice"));
  fresh();
  replace_in_json("-12.1", "-14.1");
  EXPECT_THAT(error_of<IoError>(target()), HasSubstr("lies elsewhere"));
  fresh();
  fs::resize_file(target() / "case.json", 500);
  EXPECT_THAT(error_of<IoError>(target()), HasSubstr("damaged"));
}

TEST_F(CaseFolder, TextsThatNestWithoutEndAreRefused) {
  const std::string deep = std::string(300'000, '[') + std::string(300'000, ']');
  write_case(small_case(), target());
  replace_in_json("\"size\": [", "\"size\": [" + deep + ",");
  EXPECT_THAT(error_of<IoError>(target()), AllOf(HasSubstr("case.json"), HasSubstr("too deeply")));
  write_case(small_case(), target(), Overwrite::Replace);
  std::ofstream(target() / "hand_motion.json")
      << R"({"format":"carpus hand motion","schema_version":1,"limits":{"flexion_rad":[)" << deep
      << ",1]}}";
  EXPECT_THAT(error_of<IoError>(target()),
              AllOf(HasSubstr("hand_motion.json"), HasSubstr("too deeply")));
}

TEST_F(CaseFolder, IncompleteCasesAreNotWritten) {
  cases::CaseData data = small_case();
  data.bones[0].distance_field = {};
  EXPECT_THROW(write_case(data, target()), InvalidInput);
  EXPECT_THROW(write_case({}, target()), InvalidInput);
  EXPECT_EQ(entries(), 0);
}

}  // namespace
}  // namespace carpus::case_io
