// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/segment_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "case_io/read_volume.hpp"
#include "case_io/surface_file.hpp"
#include "case_io/write_volume.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "core/units.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr double kRadius = 5;
const std::array<Vec3, 2> kMiddles{Vec3{7, 8, 8}, Vec3{18.5, 8, 8}};

/// Two simulated balls of bone, 1.5 mm apart, in soft tissue; a folder for what is made of them.
class Segment : public testing::Test {
 protected:
  Segment() {
    std::string name = (fs::temp_directory_path() / "segment_XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    GridGeometry g;
    g.size = {52, 32, 32};
    g.spacing = {0.5, 0.5, 0.5};
    Grid<std::int16_t> ct(g);
    Rng rng(5);
    for (std::size_t i = 0; i < ct.values().size(); ++i) {
      const VoxelIndex v = g.index_of(i);
      const Vec3 p{v.x * 0.5, v.y * 0.5, v.z * 0.5};
      double hu = 45;
      for (const Vec3& middle : kMiddles) {
        const double depth = kRadius - distance(p, middle);
        if (depth > 0) hu = depth < 1.2 ? 1200 : 300;
      }
      ct[i] = static_cast<std::int16_t>(std::lround(hu + 15 * rng.normal()));
    }
    case_io::write_volume<std::int16_t>(folder_ / "ct.nii.gz", ct.view());
  }
  ~Segment() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  void run(std::vector<std::string> words) const {
    CLI::App app;
    add_segment_command(app);
    words.insert(words.begin(), {"segment", (folder_ / "ct.nii.gz").string(), "--out",
                                 (folder_ / "labels.nii.gz").string()});
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    app.parse(words);
  }
  [[nodiscard]] std::string file(const char* name) const { return (folder_ / name).string(); }
  [[nodiscard]] Grid<std::uint8_t> labels() const {
    return case_io::read_labels(folder_ / "labels.nii.gz");
  }
  void write(const char* name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  template <typename Refusal>
  std::string refusal_of(const std::vector<std::string>& words) const {
    try {
      run(words);
    } catch (const Refusal& error) {
      return error.what();
    }
    return "nothing refused";
  }

  fs::path folder_;
};

std::uint8_t label_at(const Grid<std::uint8_t>& labels, const Vec3& p) {
  return labels[(VoxelIndex{static_cast<int>(std::lround(p.x / 0.5)),
                            static_cast<int>(std::lround(p.y / 0.5)),
                            static_cast<int>(std::lround(p.z / 0.5))})];
}

double dice(const Grid<std::uint8_t>& labels, std::uint8_t label, const Vec3& middle) {
  double both = 0, found = 0, there = 0;
  for (std::size_t i = 0; i < labels.values().size(); ++i) {
    const VoxelIndex v = labels.geometry().index_of(i);
    const bool in_ball = distance({v.x * 0.5, v.y * 0.5, v.z * 0.5}, middle) < kRadius;
    there += in_ball ? 1 : 0;
    found += labels[i] == label ? 1 : 0;
    both += in_ball && labels[i] == label ? 1 : 0;
  }
  return 2 * both / (found + there);
}

TEST_F(Segment, FindsTheMarkersByItself) {
  run({"--json", file("figures.json"), "--pictures", file("pictures"), "--surfaces",
       file("surfaces")});
  const Grid<std::uint8_t> found = labels();
  for (const Vec3& middle : kMiddles) {
    const std::uint8_t label = label_at(found, middle);
    EXPECT_NE(label, 0);
    EXPECT_GT(dice(found, label, middle), 0.93);
  }
  EXPECT_NE(label_at(found, kMiddles[0]), label_at(found, kMiddles[1]));
  EXPECT_EQ(label_at(found, {12.75, 8, 8}), 0);
  for (const char* name : {"1_ct.png", "2_gradient_and_markers.png", "3_watershed.png"}) {
    EXPECT_GT(fs::file_size(folder_ / "pictures" / name), 500U) << name;
  }
  EXPECT_GT(fs::file_size(folder_ / "pictures/4_bones.svg"), 5000U);
  const TriangleMesh first = case_io::read_surface(folder_ / "surfaces/label_1.ply");
  EXPECT_EQ(check_surface(first), SurfaceStatus::Ok);
  EXPECT_NEAR(volume_of(first), 4.0 / 3 * kPi * kRadius * kRadius * kRadius, 50);
}

TEST_F(Segment, FloodsFromPointsAndFromAVolumeAlike) {
  write("points.csv", "label,x,y,z,radius\n5,7,8,8,3\n9,18.5,8,8,3\n2,1,1,1,0.5\n");
  const std::vector<std::string> words{"--outside", "2", "--neighbours", "26"};
  auto from_points = words;
  from_points.insert(from_points.end(),
                     {"--markers", file("points.csv"), "--write-markers", file("m.nrrd")});
  run(from_points);
  const Grid<std::uint8_t> first = labels();
  EXPECT_GT(dice(first, 5, kMiddles[0]), 0.9);
  EXPECT_GT(dice(first, 9, kMiddles[1]), 0.9);
  EXPECT_EQ(label_at(first, {1, 1, 1}), 0);
  auto from_volume = words;
  from_volume.insert(from_volume.end(), {"--markers", file("m.nrrd"), "--force"});
  run(from_volume);
  const Grid<std::uint8_t> second = labels();
  EXPECT_TRUE(std::equal(first.values().begin(), first.values().end(), second.values().begin()));
}

TEST_F(Segment, LeavesDamsKeepsSlicesApartAndStaysInItsRegion) {
  write("points.csv", "5,7,8,8,3\n9,18.5,8,8,3\n");
  run({"--markers", file("points.csv"), "--dams", "--slices", "--neighbours", "8", "--region",
       "2,0,4,24,30,12"});
  const Grid<std::uint8_t> found = labels();
  std::size_t between = 0;
  for (std::size_t i = 0; i < found.values().size(); ++i) {
    const VoxelIndex v = found.geometry().index_of(i);
    if (v.x < 4 || v.x > 48 || v.z < 8 || v.z > 24) {
      EXPECT_EQ(found[i], 0);
    }
    // A slice without a marker stays empty: the balls of 3 mm reach from 5 to 11 mm.
    if (v.z < 10 || v.z > 22) {
      EXPECT_EQ(found[i], 0);
    }
    if (v.z != 16 || v.x < 4 || v.x > 48) continue;
    if (found[i] == 0) ++between;
    if (v.x < 48 && found[i] != 0 && found[i + 1] != 0) {
      EXPECT_EQ(found[i], found[i + 1]);
    }
  }
  EXPECT_GE(between, 32U);  // a wall from side to side
}

TEST_F(Segment, RefusesWhatDoesNotFit) {
  write("beyond.csv", "5,7,8,80\n");
  EXPECT_THAT(refusal_of<InvalidInput>({"--markers", file("beyond.csv")}),
              HasSubstr("outside the scan"));
  EXPECT_THAT(refusal_of<InvalidInput>({"--region", "100,0,0,110,9,9"}), HasSubstr("no voxel"));
  EXPECT_THAT(refusal_of<UsageError>({"--neighbours", "8"}), HasSubstr("--slices"));
  EXPECT_THAT(refusal_of<UsageError>({"--slices", "--neighbours", "26"}), HasSubstr("4 or 8"));
  EXPECT_THAT(refusal_of<UsageError>({"--outside", "2"}), HasSubstr("--markers"));
  case_io::write_volume<std::uint8_t>(folder_ / "other.nrrd",
                                      Grid<std::uint8_t>(GridGeometry{{4, 4, 4}}, 1).view());
  EXPECT_THAT(refusal_of<InvalidInput>({"--markers", file("other.nrrd")}),
              HasSubstr("not on the grid"));
  EXPECT_THAT(refusal_of<UsageError>({"--write-markers", file("labels.nii.gz")}),
              HasSubstr("names the file of the labels"));
  EXPECT_THAT(refusal_of<InvalidInput>({"--write-markers", file("markers.txt")}),
              HasSubstr("no ending"));
  EXPECT_THAT(refusal_of<UsageError>({"--pictures", file("steps"), "--slice", "99"}),
              HasSubstr("from 0 to 31"));
  EXPECT_FALSE(fs::exists(folder_ / "labels.nii.gz"));
  write("labels.nii.gz", "mine");
  EXPECT_THAT(refusal_of<IoError>({}), HasSubstr("--force"));
}

TEST_F(Segment, StoppedWritesNothing) {
  // Noted while it works: before and after, the signal would end this program.
  struct StopAtOnce {
    StopAtOnce() {
      std::signal(SIGALRM, [](int) {
        struct sigaction now {};
        ::sigaction(SIGINT, nullptr, &now);
        if (now.sa_handler != SIG_DFL) std::raise(SIGINT);
      });
    }
    ~StopAtOnce() { std::signal(SIGALRM, SIG_DFL); }
  } stop_at_once;
  constexpr itimerval kSoon{{0, 2000}, {0, 2000}};
  constexpr itimerval kNever{};
  ::setitimer(ITIMER_REAL, &kSoon, nullptr);
  const std::string refusal = refusal_of<Error>({});
  ::setitimer(ITIMER_REAL, &kNever, nullptr);
  EXPECT_THAT(refusal, HasSubstr("nothing was written"));
  EXPECT_FALSE(fs::exists(folder_ / "labels.nii.gz"));
}

}  // namespace
}  // namespace carpus::cli
