// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/dicom_segmentation.hpp"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmfg/fgfracon.h>
#include <dcmtk/dcmfg/fgpixmsr.h>
#include <dcmtk/dcmfg/fgplanor.h>
#include <dcmtk/dcmfg/fgplanpo.h>
#include <dcmtk/dcmseg/segdoc.h>
#include <dcmtk/dcmseg/segment.h>
#include <dcmtk/oflog/oflog.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <span>

#include "case_io/detail/dicom_text.hpp"
#include "case_io/detail/disk_space.hpp"
#include "core/error.hpp"
#include "core/state_hash.hpp"

namespace carpus::case_io {
namespace {

/// One date for all: a file of the same content is the same file.
constexpr const char* kDate = "20260101";
constexpr const char* kTime = "120000";

void require(const OFCondition& condition, const std::string& what) {
  if (condition.bad()) {
    throw InvalidInput("DICOM segmentation: " + what + ": " + condition.text());
  }
}

OFString number(double v) { return {decimal(v).c_str()}; }

std::uint64_t hash_of(const GridView<const std::uint8_t>& labels) {
  StateHash hash;
  const GridGeometry& g = labels.geometry();
  for (std::size_t a = 0; a < 3; ++a) {
    hash.add(g.origin[a]);
    hash.add(g.spacing[a]);
  }
  hash.add_bytes(std::as_bytes(labels.values()));
  return hash.value();
}

/// A row in the file. DCMTK 3.6.7 packs frames wrongly whose pixels are no multiple of eight; the
/// columns added are no one's, and a segmentation need not have the matrix of its scan.
int columns_of(const GridGeometry& g) { return (g.size[0] + 7) / 8 * 8; }

using Segmentation = std::unique_ptr<DcmSegmentation>;

Segmentation make_object(const GridGeometry& g, const SegmentationDescription& about) {
  const IODGeneralEquipmentModule::EquipmentInfo equipment("Carpus", "carpus export", "none",
                                                           about.made_by.c_str());
  const ContentIdentificationMacro content(
      "1", "BONES", about.simulated ? "Bones of a simulated wrist CT" : "Bones of a wrist CT",
      "Carpus");
  DcmSegmentation* object = nullptr;
  require(DcmSegmentation::createBinarySegmentation(object, static_cast<Uint16>(g.size[1]),
                                                    static_cast<Uint16>(columns_of(g)), equipment,
                                                    content),
          "the object");
  return Segmentation(object);
}

void add_identity(DcmSegmentation& object,
                  const SegmentationDescription& about,
                  std::uint64_t seed) {
  const auto uid = [&](std::uint64_t what) { return OFString(uid_from(seed ^ what).c_str()); };
  require(object.getPatient().setPatientName(about.pseudonym.c_str()), "the pseudonym");
  require(object.getPatient().setPatientID(about.pseudonym.c_str()), "the pseudonym");
  require(object.getStudy().setStudyInstanceUID(uid(1)), "the study");
  require(object.getStudy().setStudyDate(kDate), "the date");
  require(object.getStudy().setStudyTime(kTime), "the time");
  require(object.getSeries().setSeriesInstanceUID(uid(2)), "the series");
  require(object.getSeries().setSeriesNumber("2"), "the series");
  require(object.getSeries().setSeriesDescription(about.simulated ? "Bones (simulated)" : "Bones"),
          "the series");
  require(object.getFrameOfReference().setFrameOfReferenceUID(uid(3)), "the frame of reference");
  require(object.getSOPCommon().setSOPInstanceUID(uid(4)), "the instance");
  IODMultiframeDimensionModule& dimensions = object.getDimensions();
  require(dimensions.addDimensionIndex(DCM_ReferencedSegmentNumber, uid(5),
                                       DCM_SegmentIdentificationSequence, "segment"),
          "the dimensions");
  require(dimensions.addDimensionIndex(DCM_ImagePositionPatient, uid(5), DCM_PlanePositionSequence,
                                       "slice"),
          "the dimensions");
}

void add_shared_geometry(DcmSegmentation& object, const GridGeometry& g) {
  FGPixelMeasures measures;
  require(measures.setPixelSpacing((decimal(g.spacing.y) + "\\" + decimal(g.spacing.x)).c_str()),
          "the spacing");
  require(measures.setSliceThickness(number(g.spacing.z)), "the spacing");
  require(measures.setSpacingBetweenSlices(number(g.spacing.z)), "the spacing");
  require(object.addForAllFrames(measures), "the spacing");
  const Vec3 row = g.direction.column(0);
  const Vec3 column = g.direction.column(1);
  const std::unique_ptr<FGPlaneOrientationPatient> plane(FGPlaneOrientationPatient::createMinimal(
      number(row.x), number(row.y), number(row.z), number(column.x), number(column.y),
      number(column.z)));
  if (!plane) throw InvalidInput("DICOM segmentation: the axes are no directions");
  require(object.addForAllFrames(*plane), "the axes");
}

Uint16 add_segment(DcmSegmentation& object, const SegmentName& named, const std::string& made_by) {
  // SNOMED CT, as DICOM's context groups 7150 and 7159 use it.
  const CodeSequenceMacro category("123037004", "SCT", "Anatomical Structure");
  const CodeSequenceMacro type("272673000", "SCT", "Bone");
  DcmSegment* segment = nullptr;
  require(DcmSegment::create(segment, named.name.c_str(), category, type,
                             DcmSegTypes::SAT_AUTOMATIC, made_by.c_str()),
          named.name);
  Uint16 segment_number = 0;
  require(object.addSegment(segment, segment_number), named.name);
  return segment_number;
}

void add_frames(DcmSegmentation& object,
                const GridView<const std::uint8_t>& labels,
                std::uint8_t label,
                Uint16 segment) {
  const GridGeometry& g = labels.geometry();
  const auto area = static_cast<std::size_t>(g.size[0]) * static_cast<std::size_t>(g.size[1]);
  const auto columns = static_cast<std::ptrdiff_t>(columns_of(g));
  std::vector<Uint8> pixels(static_cast<std::size_t>(columns) *
                            static_cast<std::size_t>(g.size[1]));
  for (int z = 0; z < g.size[2]; ++z) {
    const auto slice = labels.values().subspan(static_cast<std::size_t>(z) * area, area);
    if (std::find(slice.begin(), slice.end(), label) == slice.end()) continue;
    for (int y = 0; y < g.size[1]; ++y) {
      const auto from = slice.begin() + static_cast<std::ptrdiff_t>(y) * g.size[0];
      std::transform(from, from + g.size[0], pixels.begin() + y * columns,
                     [label](std::uint8_t v) { return v == label ? Uint8{1} : Uint8{0}; });
    }
    const Vec3 place = g.patient_from_voxel({0, 0, static_cast<double>(z)});
    FGFrameContent content;
    require(content.setStackID("1"), "a frame");
    require(content.setInStackPositionNumber(static_cast<Uint32>(z + 1)), "a frame");
    require(content.setDimensionIndexValues(segment, 0), "a frame");
    require(content.setDimensionIndexValues(static_cast<Uint32>(z + 1), 1), "a frame");
    const std::unique_ptr<FGPlanePosPatient> position(
        FGPlanePosPatient::createMinimal(number(place.x), number(place.y), number(place.z)));
    if (!position) throw InvalidInput("DICOM segmentation: a slice's place is no number");
    OFVector<FGBase*> groups;
    groups.push_back(&content);
    groups.push_back(position.get());
    require(object.addFrame(pixels.data(), segment, groups), "a frame");
  }
}

void check_grid(const GridGeometry& g) {
  constexpr int kMost = std::numeric_limits<Uint16>::max();
  if (g.voxel_count() == 0 || columns_of(g) > kMost || g.size[1] > kMost) {
    throw InvalidInput("a DICOM segmentation holds slices of 1 to 65535 x 65535 voxels");
  }
  if (g.direction.determinant() < 0) {
    throw InvalidInput("a DICOM segmentation needs right-handed axes; reverse the slices");
  }
}

}  // namespace

void write_dicom_segmentation(const std::filesystem::path& file,
                              const GridView<const std::uint8_t>& labels,
                              const std::vector<SegmentName>& names,
                              const SegmentationDescription& description) {
  OFLog::configure(OFLogger::OFF_LOG_LEVEL);  // what fails is thrown
  check_grid(labels.geometry());
  const Segmentation object = make_object(labels.geometry(), description);
  add_identity(*object, description, hash_of(labels));
  add_shared_geometry(*object, labels.geometry());
  for (const SegmentName& named : names) {
    if (std::find(labels.values().begin(), labels.values().end(), named.label) ==
        labels.values().end()) {
      continue;
    }
    add_frames(*object, labels, named.label, add_segment(*object, named, description.made_by));
  }
  if (object->getNumberOfFrames() == 0) {
    throw InvalidInput("DICOM segmentation: no label of a name occurs in the volume");
  }
  DcmFileFormat content;
  DcmDataset& dataset = *content.getDataset();
  require(object->writeDataset(dataset), "the object");
  // DCMTK says when it wrote, to the second.
  require(dataset.putAndInsertString(DCM_ContentDate, kDate), "the date");
  require(dataset.putAndInsertString(DCM_ContentTime, kTime), "the time");
  if (content.saveFile(file.c_str(), EXS_LittleEndianExplicit).bad()) throw_cannot_write(file);
}

}  // namespace carpus::case_io
