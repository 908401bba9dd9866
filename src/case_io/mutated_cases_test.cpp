// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Surfaces, point sets and case folders, damaged at random: refused by name or read, never a crash,
// a hang or the memory that they claim. What they say is mostly said once, so acceptance is no
// error; what a case says twice (a grid, a hull of its surface, a checksum) is case_folder_test's
// matter.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "case_io/case_folder.hpp"
#include "case_io/detail/structures_json.hpp"
#include "case_io/dicom_segmentation.hpp"
#include "case_io/mutation_test_support.hpp"
#include "case_io/read_dicom_segmentation.hpp"
#include "case_io/small_case_test_support.hpp"
#include "case_io/small_tissue_test_support.hpp"
#include "case_io/soft_tissue_folder.hpp"
#include "case_io/surface_file.hpp"
#include "case_io/trust_file.hpp"
#include "core/amount_test_support.hpp"
#include "core/error.hpp"

namespace carpus::case_io {
namespace {

namespace fs = std::filesystem;

struct Target {
  std::string name;
  fs::path changed;
  std::function<void()> read;
};

class MutatedCases : public ::testing::Test {
 protected:
  MutatedCases()
      : folder_(fs::temp_directory_path() /
                ("carpus_mutated_cases_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~MutatedCases() override { fs::remove_all(folder_); }
  [[nodiscard]] const fs::path& folder() const { return folder_; }

  void damage(const std::vector<Target>& targets, std::size_t tries) {
    const test::MemoryLimit limit(rlim_t{2} << 30U);
    Rng rng(21);
    std::printf("%-28s %7s %8s %9s %9s\n", "file", "tried", "refused", "accepted", "slowest s");
    for (const Target& target : targets) {
      const std::string whole = test::bytes_of(target.changed);
      target.read();
      std::size_t refused = 0;
      double slowest_s = 0;
      for (std::size_t i = 0; i < tries; ++i) {
        test::write(target.changed, test::mutated(whole, rng));
        const auto began = std::chrono::steady_clock::now();
        try {
          target.read();
        } catch (const Error& error) {
          ++refused;
          EXPECT_FALSE(test::is_failure_of_child(error.what())) << error.what();
          EXPECT_NE(std::string(error.what()).find(folder_.string()), std::string::npos)
              << error.what();
        }
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
        slowest_s = std::max(slowest_s, took.count());
      }
      test::write(target.changed, whole);
      EXPECT_LT(slowest_s, 20.0) << target.name;
      std::printf("%-28s %7zu %8zu %9zu %9.2f\n", target.name.c_str(), tries, refused,
                  tries - refused, slowest_s);
    }
  }

 private:
  fs::path folder_;
};

TEST_F(MutatedCases, SurfacesAndPointsAreRefusedByNameOrRead) {
  std::vector<Target> targets;
  const TriangleMesh mesh = test::small_case().bones[0].surface;
  for (const char* name : {"s.ply", "s.stl", "s.obj", "s.off"}) {
    const fs::path file = folder() / name;
    write_surface(file, mesh);
    targets.push_back({name, file, [file] { (void)read_surface(file); }});
  }
  const fs::path points = folder() / "p.xyz";
  test::write(points, "0 0 0\n1.5 -2e3 7\n# a remark\n3 4 5\n");
  targets.push_back({"p.xyz", points, [points] { (void)read_surface(points); }});
  const fs::path planar = folder() / "p.csv";
  test::write(planar, "x,y\n0,1\n2.5;-3\n4 5\n");
  targets.push_back({"p.csv", planar, [planar] { (void)read_planar_points(planar); }});
  damage(targets, carpus::test::amount<std::size_t>(100, 500, 3000));
}

TEST_F(MutatedCases, CaseFoldersAreRefusedByNameOrRead) {
  const fs::path whole = folder() / "wrist";
  write_case(test::small_case(), whole);
  std::vector<Target> targets;
  for (const char* name :
       {"case.json", "hand_motion.json", "ct.nii.gz", "labels.nii.gz", "skin.ply",
        "bones/lunate.ply", "hulls/lunate.ply", "fields/lunate.nrrd"}) {
    targets.push_back({name, whole / name, [whole] { (void)read_case(whole); }});
  }
  damage(targets, carpus::test::amount<std::size_t>(3, 15, 500));
}

TEST_F(MutatedCases, WhatLiesBesideACaseIsRefusedByNameOrRead) {
  const fs::path whole = folder() / "wrist";
  const cases::CaseData data = test::small_case();
  write_case(data, whole);
  test::write(whole / "structures.json", structures_text(test::small_structures()));
  test::write(whole / kTrustFile, trust_text({{{"lunate", 0.5, true, "why"}}}, "carpus"));
  write_soft_tissue(test::small_tissue(), data, whole);
  const fs::path segments = folder() / "labels.dcm";
  write_dicom_segmentation(segments, data.labels.view(), {{data.bones[0].label, "lunate"}},
                           {"small", true, "carpus"});
  const GridGeometry grid = data.labels.geometry();
  const std::vector<Target> targets{
      {"structures.json", whole / "structures.json",
       [whole] {
         const fs::path file = whole / "structures.json";
         (void)parse_structures(test::bytes_of(file), file);
       }},
      {"trust.json", whole / kTrustFile, [whole] { (void)read_trust(whole); }},
      {"soft_tissue.json", whole / "soft_tissue/soft_tissue.json",
       [whole] { (void)read_soft_tissue(whole); }},
      {"labels.dcm", segments,
       [segments, grid] { (void)read_dicom_segmentation(segments, grid); }}};
  damage(targets, carpus::test::amount<std::size_t>(10, 60, 2000));
}

}  // namespace
}  // namespace carpus::case_io
