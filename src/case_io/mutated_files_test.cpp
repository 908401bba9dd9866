// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Files of every format, damaged at random thousands of times: what was refused, what was accepted,
// and of that what no reader could have known. Prints the table.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "case_io/mutation_test_support.hpp"
#include "case_io/read_volume.hpp"
#include "case_io/write_volume.hpp"
#include "core/amount_test_support.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"

namespace carpus::case_io {
namespace {

namespace fs = std::filesystem;
using test::bytes_of;
using test::is_failure_of_child;
using test::MemoryLimit;
using test::mutated;
using test::write;

/// What a format states so that a change of it can be seen.
struct Redundancy {
  bool voxels = false;    ///< a checksum over the voxels
  bool geometry = false;  ///< place and spacing twice, or in every slice
  bool scaling = false;   ///< slope and intercept in every slice
};

struct Format {
  std::string name;
  fs::path input;    ///< what is read: a file or a folder
  fs::path changed;  ///< the file in it that is damaged
  Redundancy has;
  bool is_by_library = false;  ///< a library decodes the voxels
};

/// The same numbers at every run; what a wrist is like: smooth, with noise.
Grid<std::int16_t> small_ct() {
  GridGeometry g;
  g.size = {21, 17, 9};
  g.spacing = {0.3, 0.35, 0.625};
  g.origin = {-45.75, 12.25, 101.5};
  g.direction = rotation_about({0, 0, 1}, -0.13);
  Grid<std::int16_t> ct(g);
  Rng rng(5);
  for (auto& v : ct.values()) v = static_cast<std::int16_t>(rng.below(2900)) - 1000;
  return ct;
}

std::string packed_by_zlib(const std::string& bytes, int window_bits) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, window_bits, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&stream, bytes.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

void replace_in(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
}

class MutatedFiles : public ::testing::Test {
 protected:
  MutatedFiles()
      : folder_(fs::temp_directory_path() / ("carpus_mutated_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    make_volume_files();
    make_series();
  }
  ~MutatedFiles() override { fs::remove_all(folder_); }
  [[nodiscard]] const std::vector<Format>& formats() const { return formats_; }

 private:
  void add_file(const std::string& name, Redundancy has) {
    formats_.push_back({name, folder_ / name, folder_ / name, has, false});
  }

  void make_volume_files() {
    const Grid<std::int16_t> ct = small_ct();
    const std::string voxels(reinterpret_cast<const char*>(ct.values().data()),
                             ct.values().size_bytes());
    for (const char* name : {"v.nii", "v.nii.gz", "v.nrrd", "v.mha"}) {
      write_volume<std::int16_t>(folder_ / name, ct.view(), "simulated");
    }
    add_file("v.nii", {false, true, false});
    add_file("v.nii.gz", {true, true, true});
    add_file("v.nrrd", {});
    add_file("v.mha", {});
    std::string nrrd = bytes_of(folder_ / "v.nrrd");
    nrrd.resize(nrrd.size() - voxels.size());
    replace_in(nrrd, "encoding: raw", "encoding: gzip");
    write(folder_ / "packed.nrrd", nrrd + packed_by_zlib(voxels, 15 + 16));
    add_file("packed.nrrd", {true, false, true});
    std::string meta = bytes_of(folder_ / "v.mha");
    meta.resize(meta.size() - voxels.size());
    const std::string packed = packed_by_zlib(voxels, 15);
    replace_in(meta, "CompressedData = False",
               "CompressedData = True\nCompressedDataSize = " + std::to_string(packed.size()));
    write(folder_ / "packed.mha", meta + packed);
    add_file("packed.mha", {true, false, true});
  }

  void make_series() {
    write_dicom_series(folder_ / "dicom", small_ct().view(), {});
    add_series("dicom", {false, true, true}, false);
    if (std::system("gdcmconv --version > /dev/null 2>&1") != 0) return;
    for (const char* syntax :
         {"--implicit", "--deflated", "--rle", "--jpeg", "--jpegls", "--j2k"}) {
      const std::string name = std::string("dicom_") + (syntax + 2);
      fs::create_directory(folder_ / name);
      for (const auto& entry : fs::directory_iterator(folder_ / "dicom")) {
        const std::string command = std::string("gdcmconv ") + syntax + " '" +
                                    entry.path().string() + "' '" +
                                    (folder_ / name / entry.path().filename()).string() + "'";
        ASSERT_EQ(std::system(command.c_str()), 0) << command;
      }
      const bool is_by_library =
          name == "dicom_jpeg" || name == "dicom_jpegls" || name == "dicom_j2k";
      add_series(name, {name == "dicom_deflated", true, true}, is_by_library);
    }
  }

  void add_series(const std::string& name, Redundancy has, bool is_by_library) {
    formats_.push_back({name, folder_ / name, folder_ / name / "IM_0004.dcm", has, is_by_library});
    formats_.push_back(
        {name + ", end", folder_ / name, folder_ / name / "IM_0009.dcm", has, is_by_library});
  }

  fs::path folder_;
  std::vector<Format> formats_;
};

struct Row {
  std::size_t tried = 0;
  std::size_t refused = 0;
  std::size_t library_failed = 0;  ///< of these: crash, hang or memory in a child
  std::size_t same = 0;            ///< accepted, and it was the same volume
  std::size_t unknowable = 0;      ///< accepted, changed where a thing is said once
  std::size_t believed = 0;        ///< accepted, changed where the file says it twice
  double slowest_s = 0;
};

bool same_place(const GridGeometry& a, const GridGeometry& b) {
  if (a.size != b.size) return false;
  constexpr double kRoundingMm = 0.03;  // what the readers allow as rounding
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 v{};
    for (std::size_t i = 0; i < 3; ++i) v[i] = (corner >> i) % 2 == 0 ? 0.0 : a.size[i] - 1;
    if (!(distance(a.patient_from_voxel(v), b.patient_from_voxel(v)) < kRoundingMm)) return false;
  }
  return true;
}

/// Whether a changed value may come from a change of scaling or type: then many differ.
bool are_voxels_alone(const Grid<std::int16_t>& a, const Grid<std::int16_t>& b) {
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i) differing += a[i] != b[i] ? 1 : 0;
  return differing <= 60;
}

void judge(const Format& format,
           const Grid<std::int16_t>& whole,
           const Grid<std::int16_t>& read,
           Row& row) {
  if (!same_place(whole.geometry(), read.geometry())) {
    ++(format.has.geometry ? row.believed : row.unknowable);
    return;
  }
  if (std::equal(whole.values().begin(), whole.values().end(), read.values().begin())) {
    ++row.same;
    return;
  }
  const bool is_voxels = format.is_by_library || are_voxels_alone(whole, read);
  const bool is_knowable = is_voxels ? format.has.voxels : format.has.scaling;
  ++(is_knowable ? row.believed : row.unknowable);
}

void try_once(const Format& format,
              const std::string& bytes,
              const Grid<std::int16_t>& whole,
              Row& row) {
  write(format.changed, bytes);
  const auto began = std::chrono::steady_clock::now();
  const std::size_t believed = row.believed;
  try {
    const Grid<std::int16_t> read = read_ct(format.input);
    judge(format, whole, read, row);
  } catch (const Error& error) {
    ++row.refused;
    const bool is_failure = is_failure_of_child(error.what());
    row.library_failed += is_failure ? 1 : 0;
    EXPECT_TRUE(!is_failure || format.is_by_library) << error.what();
    EXPECT_NE(std::string(error.what()).find(format.input.string()), std::string::npos)
        << error.what();
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  row.slowest_s = std::max(row.slowest_s, took.count());
  if (believed == row.believed) return;
  const fs::path kept = fs::temp_directory_path() / ("believed_" + std::to_string(row.tried) + "_" +
                                                     format.changed.filename().string());
  write(kept, bytes);
  ADD_FAILURE() << format.name << ": a change was believed; kept as " << kept;
}

void print(const std::map<std::string, Row>& table) {
  std::printf("%-20s %7s %8s %9s %6s %10s %9s %9s\n", "format", "tried", "refused", "by child",
              "same", "unknowable", "believed", "slowest s");
  Row sum;
  for (const auto& [name, r] : table) {
    std::printf("%-20s %7zu %8zu %9zu %6zu %10zu %9zu %9.2f\n", name.c_str(), r.tried, r.refused,
                r.library_failed, r.same, r.unknowable, r.believed, r.slowest_s);
    sum.tried += r.tried;
    sum.refused += r.refused;
    sum.library_failed += r.library_failed;
    sum.same += r.same;
    sum.unknowable += r.unknowable;
    sum.believed += r.believed;
    sum.slowest_s = std::max(sum.slowest_s, r.slowest_s);
  }
  std::printf("%-20s %7zu %8zu %9zu %6zu %10zu %9zu %9.2f\n", "all", sum.tried, sum.refused,
              sum.library_failed, sum.same, sum.unknowable, sum.believed, sum.slowest_s);
}

TEST_F(MutatedFiles, AreRefusedOrSaySomethingThatNoReaderCouldKnow) {
  const std::size_t tries = carpus::test::amount<std::size_t>(100, 800, 20000);
  const MemoryLimit limit(rlim_t{2} << 30U);
  std::map<std::string, Row> table;
  Rng rng(20);
  for (const Format& format : formats()) {
    const std::string whole_bytes = bytes_of(format.changed);
    const Grid<std::int16_t> whole = read_ct(format.input);
    Row& row = table[format.name];
    for (std::size_t i = 0; i < tries / formats().size() + 1; ++i) {
      ++row.tried;
      try_once(format, mutated(whole_bytes, rng), whole, row);
    }
    write(format.changed, whole_bytes);
    EXPECT_EQ(row.believed, 0U) << format.name;
    EXPECT_LT(row.slowest_s, 20.0) << format.name;
  }
  print(table);
}

}  // namespace
}  // namespace carpus::case_io
