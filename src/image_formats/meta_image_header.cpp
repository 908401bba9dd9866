// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Lines "Key = value" up to ElementDataFile, which is the last.
#include "image_formats/meta_image_header.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "image_formats/header_text.hpp"

namespace carpus::image_formats {
namespace {

struct KnownType {
  std::string_view name;
  VoxelType type;
};
constexpr std::array kTypes{
    KnownType{"MET_CHAR", VoxelType::I8},       KnownType{"MET_UCHAR", VoxelType::U8},
    KnownType{"MET_SHORT", VoxelType::I16},     KnownType{"MET_USHORT", VoxelType::U16},
    KnownType{"MET_INT", VoxelType::I32},       KnownType{"MET_UINT", VoxelType::U32},
    KnownType{"MET_LONG_LONG", VoxelType::I64}, KnownType{"MET_ULONG_LONG", VoxelType::U64},
    KnownType{"MET_FLOAT", VoxelType::F32},     KnownType{"MET_DOUBLE", VoxelType::F64}};

/// An axis points along one of the patient's so clearly that its letter is beyond doubt.
constexpr double kClearCosine = 0.8;

class Parser {
 public:
  Parser(std::string_view front, const Refuser& refuse) : front_(front), refuse_(refuse) {}

  VolumeHeader run() {
    read_lines();
    check_kind();
    VolumeHeader header;
    header.description = optional({"ITK_FileNotes"});
    take_type(header);
    take_storage(header);
    header.geometry = geometry();
    return header;
  }

 private:
  void read_lines() {
    std::string_view rest = front_;
    std::string_view line;
    while (!fields_.contains("ElementDataFile") && take_line(rest, line)) {
      const std::size_t equals = line.find('=');
      if (equals == std::string_view::npos) {
        if (trimmed(line).empty()) continue;
        refuse_.damaged("a line of its header", "'" + printable(line) + "'",
                        "where 'Key = value' is needed");
      }
      const std::string_view key = trimmed(line.substr(0, equals));
      const std::string_view value = trimmed(line.substr(equals + 1));
      if (!fields_.emplace(std::string(key), value).second) {
        refuse_.damaged(printable(key), "there twice", "one of the two is wrong");
      }
    }
    if (!fields_.contains("ElementDataFile")) {
      refuse_.damaged("its header", "without ElementDataFile", "which ends a MetaImage's");
    }
    header_bytes_ =
        rest.empty() ? front_.size() : static_cast<std::size_t>(rest.data() - front_.data());
  }

  /// The value under one of several names; where it stands under two, they must agree.
  [[nodiscard]] std::string optional(std::initializer_list<std::string_view> names) const {
    std::string value;
    for (const std::string_view name : names) {
      const auto found = fields_.find(name);
      if (found == fields_.end()) continue;
      if (!value.empty() && value != found->second) {
        refuse_.damaged(name, "'" + printable(found->second) + "'",
                        "but " + std::string(*names.begin()) + " says otherwise");
      }
      value = found->second;
    }
    return value;
  }
  [[nodiscard]] std::string needed(std::initializer_list<std::string_view> names) const {
    std::string value = optional(names);
    if (value.empty()) refuse_.damaged(*names.begin(), "missing", "its header needs it");
    return value;
  }
  [[nodiscard]] bool flag(std::initializer_list<std::string_view> names, bool otherwise) const {
    const std::string value = optional(names);
    const std::string word = lower(value);
    if (word == "true" || word == "1") return true;
    if (word == "false" || word == "0") return false;
    if (!value.empty())
      refuse_.damaged(*names.begin(), "'" + printable(value) + "'", "not True or False");
    return otherwise;
  }
  [[nodiscard]] std::vector<double> numbers(std::initializer_list<std::string_view> names,
                                            std::size_t count) const {
    const std::string value = needed(names);
    std::vector<double> all = numbers_of(value, count);
    if (all.empty()) {
      refuse_.damaged(*names.begin(), "'" + printable(value) + "'",
                      "where " + std::to_string(count) + " numbers are needed");
    }
    return all;
  }

  void check_kind() const {
    if (needed({"ObjectType"}) != "Image") {
      refuse_.unusable("ObjectType", "'" + printable(needed({"ObjectType"})) + "'",
                       "only images are read");
    }
    if (needed({"NDims"}) != "3") {
      refuse_.unusable("NDims", "'" + printable(needed({"NDims"})) + "'",
                       "a CT has 3; save one time point as a volume and open that");
    }
    const std::string channels = optional({"ElementNumberOfChannels"});
    if (!channels.empty() && channels != "1") {
      refuse_.unusable("ElementNumberOfChannels", "'" + printable(channels) + "'",
                       "a CT has one value a voxel");
    }
    if (!flag({"BinaryData"}, false)) {
      refuse_.unusable("BinaryData", "not True", "save it as binary and open that");
    }
    for (const auto& [name, neutral] : {std::pair{"ElementToIntensityFunctionSlope", 1.0},
                                        std::pair{"ElementToIntensityFunctionOffset", 0.0}}) {
      const std::string value = optional({name});
      if (!value.empty() && number_of(value) != neutral) {
        refuse_.unusable(name, "'" + printable(value) + "'",
                         "save it with values in HU and open that");
      }
    }
  }

  void take_type(VolumeHeader& header) const {
    const std::string type = needed({"ElementType"});
    const auto* known = std::find_if(kTypes.begin(), kTypes.end(),
                                     [&](const KnownType& k) { return k.name == type; });
    if (known == kTypes.end()) {
      refuse_.unusable("ElementType", "'" + printable(type) + "'",
                       "convert it to 16-bit integers and open it again");
    }
    header.type = known->type;
    if (size_of(header.type) > 1) (void)needed({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"});
    header.is_big_endian = flag({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"}, false);
  }

  void take_storage(VolumeHeader& header) const {
    const std::string data = needed({"ElementDataFile"});
    if (lower(data) == "local") {
      header.stored_begins = header_bytes_;
    } else if (!is_plain_file_name(data) || words_of(data).size() != 1 || lower(data) == "list" ||
               data.find('%') != std::string::npos) {
      refuse_.unusable("ElementDataFile", "'" + printable(data) + "'",
                       "only the name of one file in the same folder is read; save it as one .mha");
    } else {
      header.data_file = data;
    }
    const std::string skip = optional({"HeaderSize"});
    const auto bytes = integer_of(skip.empty() ? "0" : skip);
    if (!bytes || *bytes < -1 || (*bytes != 0 && header.data_file.empty())) {
      refuse_.unusable("HeaderSize", "'" + printable(skip) + "'", "save it without and open that");
    }
    header.lies_at_end = *bytes == -1;
    if (*bytes > 0) header.stored_begins = static_cast<std::uint64_t>(*bytes);
    const std::string packed = optional({"CompressedDataSize"});
    if (!flag({"CompressedData"}, false)) return;
    header.packing = Packing::Zlib;
    if (header.lies_at_end) {
      refuse_.unusable("HeaderSize", "-1", "save it without and open that");
    }
    if (packed.empty()) return;
    const auto size = integer_of(packed);
    if (!size || *size < 1) {
      refuse_.damaged("CompressedDataSize", "'" + printable(packed) + "'", "no number of bytes");
    }
    header.packed_bytes = static_cast<std::uint64_t>(*size);
  }

  [[nodiscard]] GridGeometry geometry() const {
    StatedGeometry stated;
    const std::vector<double> size = numbers({"DimSize"}, 3);
    const std::vector<double> spacing = numbers({"ElementSpacing"}, 3);
    const std::vector<double> origin = numbers({"Offset", "Position", "Origin"}, 3);
    const std::vector<double> matrix = numbers({"TransformMatrix", "Orientation", "Rotation"}, 9);
    for (std::size_t i = 0; i < 3; ++i) {
      stated.size[i] = size[i];
      stated.spacing[i] = spacing[i];
      stated.origin[i] = origin[i];
      stated.axes[i] = {matrix[3 * i], matrix[3 * i + 1], matrix[3 * i + 2]};
    }
    GridGeometry g = usable_geometry(stated, refuse_);
    check_orientation(g.direction);
    return g;
  }

  /// Letters say where an axis comes from: R is an axis that runs from right to left, +x of LPS.
  void check_orientation(const Mat3& direction) const {
    const std::string letters = optional({"AnatomicalOrientation"});
    if (letters.size() != 3 || letters.find_first_not_of("RLAPIS") != std::string::npos) return;
    constexpr std::array<std::string_view, 3> kFrom{"RL", "AP", "IS"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Vec3 along = direction.column(axis);
      for (std::size_t k = 0; k < 3; ++k) {
        if (!(std::abs(along[k]) > kClearCosine)) continue;
        if (letters[axis] != kFrom[k][along[k] > 0 ? 0 : 1]) {
          refuse_.damaged("AnatomicalOrientation", letters, "but TransformMatrix says otherwise");
        }
      }
    }
  }

  std::string_view front_;
  const Refuser& refuse_;
  std::map<std::string, std::string_view, std::less<>> fields_;
  std::size_t header_bytes_ = 0;
};

}  // namespace

VolumeHeader parse_meta_image(std::string_view front, const Refuser& refuse) {
  return Parser(front, refuse).run();
}

}  // namespace carpus::image_formats
