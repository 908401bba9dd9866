// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// NIfTI, NRRD and MetaImage: what is read, and each thing that is refused, by its field's name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "core/error.hpp"
#include "image_formats/meta_image_header.hpp"
#include "image_formats/nifti_header.hpp"
#include "image_formats/nrrd_header.hpp"

namespace carpus::image_formats {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using namespace std::string_literals;

template <typename T>
void put(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// 4 x 5 x 6 voxels of 0.3 x 0.35 x 0.625 mm, axes along LPS, as every header here says.
std::string nifti() {
  std::string h(kNiftiFrontBytes, '\0');
  put(h, 0, std::int32_t{348});
  const std::array<std::int16_t, 8> dim{3, 4, 5, 6, 1, 1, 1, 1};
  put(h, 40, dim);
  put(h, 70, std::int16_t{4});
  put(h, 72, std::int16_t{16});
  const std::array<float, 8> pixdim{1, 0.3F, 0.35F, 0.625F, 1, 1, 1, 1};
  put(h, 76, pixdim);
  put(h, 108, 352.0F);
  put(h, 112, 1.0F);
  h[123] = 2;
  put(h, 252, std::int16_t{1});
  put(h, 254, std::int16_t{1});
  const std::array<float, 6> quaternion{0, 0, 1, 45.75F, -12.25F, 101.5F};
  put(h, 256, quaternion);
  const std::array<float, 12> rows{-0.3F, 0,       0, 45.75F, 0,      -0.35F,
                                   0,     -12.25F, 0, 0,      0.625F, 101.5F};
  put(h, 280, rows);
  std::memcpy(h.data() + 344, "n+1", 4);
  return h;
}

std::string nrrd(const std::string& more = "", const std::string& encoding = "raw") {
  return "NRRD0004\n# a remark\ntype: short\ndimension: 3\nspace: left-posterior-superior\n"
         "sizes: 4 5 6\nspace directions: (0.3,0,0) (0,0.35,0) (0,0,0.625)\n"
         "kinds: domain domain domain\nendian: little\nencoding: " +
         encoding + "\nspace origin: (-45.75,12.25,101.5)\n" + more + "\n";
}

std::string meta(const std::string& more = "", const std::string& data = "LOCAL") {
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n" +
         more +
         "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = -45.75 12.25 101.5\n"
         "ElementSpacing = 0.3 0.35 0.625\nDimSize = 4 5 6\nElementType = MET_SHORT\n"
         "ElementDataFile = " +
         data + "\n";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

VolumeHeader parsed_nifti(const std::string& bytes) {
  return parse_nifti(std::as_bytes(std::span(bytes)), Refuser("v.nii"));
}

template <typename Parse>
std::string refusal_of(const Parse& parse) {
  try {
    parse();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}
std::string nifti_refusal(const std::string& bytes) {
  return refusal_of([&] { (void)parsed_nifti(bytes); });
}
std::string nrrd_refusal(const std::string& text) {
  return refusal_of([&] { (void)parse_nrrd(text, Refuser("v.nrrd")); });
}
std::string meta_refusal(const std::string& text) {
  return refusal_of([&] { (void)parse_meta_image(text, Refuser("v.mha")); });
}

template <typename T>
std::string nifti_with(std::size_t at, T value) {
  std::string h = nifti();
  put(h, at, value);
  return h;
}

void expect_the_grid(const GridGeometry& g) {
  EXPECT_EQ(g.size, (std::array<int, 3>{4, 5, 6}));
  EXPECT_EQ(g.spacing, (Vec3{0.3, 0.35, 0.625}));
  EXPECT_LT(distance(g.origin, {-45.75, 12.25, 101.5}), 1e-9);
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3 axis{};
    axis[i] = 1;
    EXPECT_LT(distance(g.direction.column(i), axis), 1e-6);
  }
}

TEST(VolumeHeaders, OfEveryFormatGiveTheSameGrid) {
  expect_the_grid(parsed_nifti(nifti()).geometry);
  expect_the_grid(parse_nrrd(nrrd(), Refuser("v.nrrd")).geometry);
  expect_the_grid(parse_meta_image(meta(), Refuser("v.mha")).geometry);
  std::string ras = replaced(nrrd(), "left-posterior-superior", "RAS");
  ras = replaced(ras, "(0.3,0,0) (0,0.35,0)", "(-0.3,0,0) ( 0 , -0.35 , 0 )");
  ras = replaced(ras, "(-45.75,12.25", "(45.75,-12.25");
  expect_the_grid(parse_nrrd(ras, Refuser("v.nrrd")).geometry);
  std::string las = replaced(nrrd(), "left-posterior-superior", "left-anterior-superior");
  las = replaced(las, "(0,0.35,0)", "(0,-0.35,0)");
  las = replaced(las, "12.25,", "-12.25,");
  expect_the_grid(parse_nrrd(las, Refuser("v.nrrd")).geometry);
  expect_the_grid(parsed_nifti(nifti_with(252, std::int32_t{1})).geometry);        // qform alone
  expect_the_grid(parsed_nifti(nifti_with(252, std::int32_t{0x10000})).geometry);  // sform alone
}

TEST(VolumeHeaders, SayWhereTheVoxelsAre) {
  const VolumeHeader n = parsed_nifti(nifti());
  EXPECT_EQ(n.stored_begins, 352U);
  EXPECT_EQ(n.voxel_bytes(), 240U);
  const std::string text = nrrd();
  EXPECT_EQ(parse_nrrd(text + "voxels", Refuser("v")).stored_begins, text.size());
  const VolumeHeader beside =
      parse_nrrd(nrrd("data file: v.raw\nbyte skip: 7\n"), Refuser("v.nhdr"));
  EXPECT_EQ(beside.data_file, "v.raw");
  EXPECT_EQ(beside.stored_begins, 7U);
  EXPECT_TRUE(parse_nrrd(nrrd("data file: v.raw\nbyte skip: -1\n"), Refuser("v")).lies_at_end);
  EXPECT_EQ(parse_meta_image(meta() + "voxels", Refuser("v")).stored_begins, meta().size());
  const VolumeHeader packed =
      parse_meta_image(meta("CompressedData = True\nCompressedDataSize = 99\n"), Refuser("v.mha"));
  EXPECT_EQ(packed.packing, Packing::Zlib);
  EXPECT_EQ(packed.packed_bytes, 99U);
  EXPECT_EQ(parse_nrrd(nrrd("", "gzip"), Refuser("v")).packing, Packing::Gzip);
}

TEST(VolumeHeaders, ReadBigEndianAndScaledNifti) {
  std::string swapped = nifti();
  const auto swap = [&](std::size_t at, std::size_t size, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      std::reverse(swapped.begin() + static_cast<std::ptrdiff_t>(at + i * size),
                   swapped.begin() + static_cast<std::ptrdiff_t>(at + (i + 1) * size));
    }
  };
  swap(0, 4, 1);
  swap(40, 2, 8);
  swap(70, 2, 2);
  swap(76, 4, 8);
  swap(108, 4, 3);
  swap(252, 2, 2);
  swap(256, 4, 18);
  const VolumeHeader big = parsed_nifti(swapped);
  EXPECT_TRUE(big.is_big_endian);
  expect_the_grid(big.geometry);
  const VolumeHeader scaled = parsed_nifti(nifti_with(112, std::array<float, 2>{2, -1024}));
  EXPECT_EQ(scaled.slope, 2);
  EXPECT_EQ(scaled.intercept, -1024);
  ASSERT_EQ(scaled.conventions.size(), 1U);
  EXPECT_THAT(scaled.conventions[0], HasSubstr("x 2 + -1024"));
  EXPECT_EQ(parsed_nifti(nifti_with(112, 0.0F)).slope, 1);
  EXPECT_THAT(parsed_nifti(nifti_with(123, '\0')).conventions[0], HasSubstr("in mm"));
}

TEST(NiftiHeader, RefusesByTheFieldsName) {
  EXPECT_THAT(nifti_refusal(nifti().substr(0, 351)), HasSubstr("v.nii: the file"));
  EXPECT_THAT(nifti_refusal(nifti_with(344, 'x')), HasSubstr("its start"));
  EXPECT_THAT(nifti_refusal(nifti_with(0, std::int32_t{540})), HasSubstr("NIfTI-2"));
  EXPECT_THAT(nifti_refusal(nifti_with(70, std::int16_t{128})), HasSubstr("datatype is 128"));
  EXPECT_THAT(nifti_refusal(nifti_with(72, std::int16_t{8})), HasSubstr("bitpix is 8"));
  EXPECT_THAT(nifti_refusal(nifti_with(40, std::int16_t{2})), HasSubstr("dim[0] is 2"));
  std::string four = nifti_with(40, std::int16_t{4});
  EXPECT_EQ(nifti_refusal(four), "no error");
  put(four, 48, std::int16_t{3});
  EXPECT_THAT(nifti_refusal(four), HasSubstr("one time point"));
  EXPECT_THAT(nifti_refusal(nifti_with(42, std::int16_t{-4})), HasSubstr("its size"));
  EXPECT_THAT(nifti_refusal(nifti_with(42, std::int16_t{0})), HasSubstr("its size"));
  EXPECT_THAT(nifti_refusal(nifti_with(108, 351.0F)), HasSubstr("vox_offset is 351"));
  EXPECT_THAT(nifti_refusal(nifti_with(108, 1e30F)), HasSubstr("vox_offset"));
  EXPECT_THAT(nifti_refusal(nifti_with(112, std::numeric_limits<float>::infinity())),
              HasSubstr("scl_slope is no number"));
  EXPECT_THAT(nifti_refusal(nifti_with(123, '\x05')), HasSubstr("xyzt_units"));
  EXPECT_THAT(nifti_refusal(nifti_with(84, 0.385F)),
              AllOf(HasSubstr("pixdim[2] is 0.385 mm"), HasSubstr("sform says 0.35")));
  EXPECT_THAT(nifti_refusal(nifti_with(76, 0.5F)), HasSubstr("pixdim[0]"));
  EXPECT_THAT(nifti_refusal(nifti_with(76, -1.0F)), HasSubstr("qform"));
  EXPECT_THAT(nifti_refusal(nifti_with(252, std::int32_t{0})),
              HasSubstr("left and right are not known"));
}

TEST(NrrdHeader, RefusesByTheFieldsName) {
  EXPECT_THAT(nrrd_refusal("NRRD0009\n"), HasSubstr("v.nrrd: its start"));
  EXPECT_THAT(nrrd_refusal(""), HasSubstr("its start"));
  EXPECT_THAT(nrrd_refusal(nrrd().substr(0, 80)), HasSubstr("v.nrrd"));
  EXPECT_THAT(nrrd_refusal(nrrd("sizes: 4 5 6\n")), HasSubstr("sizes is there twice"));
  EXPECT_THAT(nrrd_refusal(nrrd("colour: blue\n")), HasSubstr("'colour'"));
  EXPECT_THAT(nrrd_refusal(nrrd("a line\n")), HasSubstr("'a line'"));
  EXPECT_EQ(nrrd_refusal(nrrd("a key:=a value\n")), "no error");
  for (const auto& [from, to, field] :
       {std::tuple{"type: short", "type: block", "type"},
        std::tuple{"type: short", "type: ,", "type"},
        std::tuple{"dimension: 3", "dimension: 4", "dimension"},
        std::tuple{"space: left", "space: scanner", "space is 'scanner-"},
        std::tuple{"sizes: 4 5 6", "sizes: 4 5", "sizes"},
        std::tuple{"sizes: 4 5 6", "sizes: 4 5 -6", "its size"},
        std::tuple{"sizes: 4 5 6", "sizes: 4 5 6.5", "its size"},
        std::tuple{"sizes: 4 5 6", "sizes: 60000 60000 60000", "crop it"},
        std::tuple{"sizes: 4 5 6", "sizes: 1e300 1e300 1e300", "crop it"},
        std::tuple{"(0,0.35,0)", "none", "space directions"},
        std::tuple{"(0,0.35,0)", "(0,0.35)", "space directions"},
        std::tuple{"(0,0.35,0)", "(0,nan,0)", "space directions"},
        std::tuple{"(0,0.35,0)", "(0,0,0)", "spacing 0 mm on axis 1"},
        std::tuple{"(0,0.35,0)", "(0,0.35,0.1)", "right angles"},
        std::tuple{"(0,0.35,0)", "(0,0.35,0) (0,0,1)", "space directions"},
        std::tuple{"domain domain", "vector domain", "kinds"},
        std::tuple{"endian: little\n", "", "endian"},
        std::tuple{"encoding: raw", "encoding: bzip2", "encoding"},
        std::tuple{"encoding: raw\n", "", "encoding is missing"},
        std::tuple{"(-45.75,", "(1e9,", "its origin"}}) {
    EXPECT_THAT(nrrd_refusal(replaced(nrrd(), from, to)), HasSubstr(field)) << to;
  }
  EXPECT_THAT(nrrd_refusal(nrrd("spacings: 0.3 0.35 0.7\n")), HasSubstr("spacings"));
  EXPECT_THAT(nrrd_refusal(nrrd("space units: \"mm\" \"mm\" \"m\"\n")), HasSubstr("space units"));
  EXPECT_THAT(nrrd_refusal(nrrd("line skip: 2\n")), HasSubstr("line skip"));
  EXPECT_THAT(nrrd_refusal(nrrd("byte skip: 2\n", "gzip")), HasSubstr("byte skip"));
  for (const char* name : {"LIST", "v%03d.raw 1 6 1", "../v.raw", "/dev/zero", "a b", ".hidden"}) {
    EXPECT_THAT(nrrd_refusal(nrrd("data file: " + std::string(name) + "\n")),
                HasSubstr("data file"))
        << name;
  }
}

TEST(MetaImageHeader, RefusesByTheFieldsName) {
  EXPECT_THAT(meta_refusal(""), HasSubstr("v.mha: its header is without ElementDataFile"));
  EXPECT_THAT(meta_refusal("no equals sign\n" + meta()), HasSubstr("'no equals sign'"));
  EXPECT_THAT(meta_refusal(meta("NDims = 3\n")), HasSubstr("NDims is there twice"));
  for (const auto& [from, to, field] :
       {std::tuple{"ObjectType = Image", "ObjectType = Tube", "ObjectType"},
        std::tuple{"NDims = 3", "NDims = -1", "NDims"},
        std::tuple{"BinaryData = True", "BinaryData = False", "BinaryData"},
        std::tuple{"BinaryData = True", "BinaryData = Maybe", "BinaryData"},
        std::tuple{"BinaryDataByteOrderMSB = False\n", "", "BinaryDataByteOrderMSB is missing"},
        std::tuple{"TransformMatrix", "TransformMatrlx", "TransformMatrix is missing"},
        std::tuple{"Offset", "Off", "Offset is missing"},
        std::tuple{"1 0 0 0 1 0", "1 0 0 0 1 0 0", "9 numbers"},
        std::tuple{"1 0 0 0 1 0", "nan 0 0 0 1 0", "9 numbers"},
        std::tuple{"1 0 0 0 1 0", "1 0 0 0 1 0.1", "right angles"},
        std::tuple{"ElementSpacing = 0.3 ", "ElementSpacing = -0.3 ", "spacing -0.3 mm on axis 0"},
        std::tuple{"DimSize = 4", "DimSize = 0", "its size"},
        std::tuple{"MET_SHORT", "MET_SHORT_ARRAY", "ElementType"}}) {
    EXPECT_THAT(meta_refusal(replaced(meta(), from, to)), HasSubstr(field)) << to;
  }
  EXPECT_THAT(meta_refusal(meta("Position = 1 2 3\n")), HasSubstr("says otherwise"));
  EXPECT_THAT(meta_refusal(meta("ElementNumberOfChannels = 3\n")),
              HasSubstr("ElementNumberOfChannels"));
  EXPECT_THAT(meta_refusal(meta("ElementToIntensityFunctionSlope = 2\n")),
              HasSubstr("ElementToIntensityFunctionSlope"));
  EXPECT_THAT(meta_refusal(meta("HeaderSize = -1\n")), HasSubstr("HeaderSize"));
  EXPECT_THAT(meta_refusal(meta("CompressedData = True\nCompressedDataSize = -3\n")),
              HasSubstr("CompressedDataSize"));
  EXPECT_EQ(meta_refusal(meta("AnatomicalOrientation = RAI\n")), "no error");
  EXPECT_EQ(meta_refusal(meta("AnatomicalOrientation = ???\n")), "no error");
  EXPECT_THAT(meta_refusal(meta("AnatomicalOrientation = LAI\n")),
              HasSubstr("AnatomicalOrientation is LAI"));
  for (const char* name : {"LIST", "v%03d.raw 1 6 1", "../v.raw", "/dev/zero", "a b", "%s%n"}) {
    EXPECT_THAT(meta_refusal(meta("", name)), HasSubstr("ElementDataFile")) << name;
  }
}

}  // namespace
}  // namespace carpus::image_formats
