// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Lines up to an empty one: "field: value", "key:=value" (free remarks) and "# comment".
#include "image_formats/nrrd_header.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "image_formats/header_text.hpp"

namespace carpus::image_formats {
namespace {

/// Every field of the format, by its first name and by its other one.
constexpr std::array<std::pair<std::string_view, std::string_view>, 31> kFields{{
    {"dimension", ""},
    {"type", ""},
    {"block size", "blocksize"},
    {"encoding", ""},
    {"endian", ""},
    {"content", ""},
    {"min", ""},
    {"max", ""},
    {"old min", "oldmin"},
    {"old max", "oldmax"},
    {"data file", "datafile"},
    {"line skip", "lineskip"},
    {"byte skip", "byteskip"},
    {"number", ""},
    {"sample units", "sampleunits"},
    {"sizes", ""},
    {"spacings", ""},
    {"thicknesses", ""},
    {"axis mins", "axismins"},
    {"axis maxs", "axismaxs"},
    {"centers", "centerings"},
    {"labels", ""},
    {"units", ""},
    {"kinds", ""},
    {"space", ""},
    {"space dimension", ""},
    {"space units", ""},
    {"space origin", ""},
    {"space directions", ""},
    {"measurement frame", ""},
    {"keyvalue", ""},
}};

/// Its first name; empty where the format has no such field.
std::string_view known_field(const std::string& name) {
  for (const auto& [first, other] : kFields) {
    if (name == first || (!other.empty() && name == other)) return first;
  }
  return {};
}

struct KnownType {
  std::string_view names;  ///< between commas
  VoxelType type;
};
constexpr std::array kTypes{
    KnownType{",signed char,int8,int8_t,", VoxelType::I8},
    KnownType{",uchar,unsigned char,uint8,uint8_t,", VoxelType::U8},
    KnownType{",short,short int,signed short,signed short int,int16,int16_t,", VoxelType::I16},
    KnownType{",ushort,unsigned short,unsigned short int,uint16,uint16_t,", VoxelType::U16},
    KnownType{",int,signed int,int32,int32_t,", VoxelType::I32},
    KnownType{",uint,unsigned int,uint32,uint32_t,", VoxelType::U32},
    KnownType{",longlong,long long,long long int,signed long long,signed long long int,int64,"
              "int64_t,",
              VoxelType::I64},
    KnownType{",ulonglong,unsigned long long,unsigned long long int,uint64,uint64_t,",
              VoxelType::U64},
    KnownType{",float,", VoxelType::F32},
    KnownType{",double,", VoxelType::F64}};

class Parser {
 public:
  Parser(std::string_view front, const Refuser& refuse) : front_(front), refuse_(refuse) {}

  VolumeHeader run() {
    read_lines();
    VolumeHeader header;
    header.description = description_;
    take_storage(header);
    header.geometry = geometry(header);
    return header;
  }

 private:
  void read_lines() {
    std::string_view rest = front_;
    std::string_view line;
    if (!take_line(rest, line) || line.size() < 8 || !line.starts_with("NRRD000") ||
        trimmed(line.substr(7)).size() != 1 || line[7] < '1' || line[7] > '5') {
      refuse_.damaged("its start", "not that of NRRD 1 to 5", "whatever its name says");
    }
    bool is_ended = false;
    while (!is_ended && take_line(rest, line)) {
      line = line.substr(0, line.size() - (line.ends_with('\r') ? 1 : 0));
      is_ended = line.empty();
      if (!is_ended && line[0] != '#') take_field(line);
    }
    header_bytes_ = static_cast<std::size_t>(rest.data() - front_.data());
    if (rest.empty() && !is_ended) header_bytes_ = front_.size();
    if (!is_ended && (front_.size() >= kLongestHeaderText || !fields_.contains("data file"))) {
      refuse_.damaged("its header", "without an end", "an empty line ends it");
    }
  }

  void take_field(std::string_view line) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) {
      refuse_.damaged("a line of its header", "'" + printable(line) + "'",
                      "which is neither a field nor a remark");
    }
    if (line.substr(colon).starts_with(":=")) {
      if (line.substr(0, colon) == "ITK_FileNotes") description_ = line.substr(colon + 2);
      return;
    }
    const std::string name = lower(line.substr(0, colon));
    const std::string_view field = known_field(name);
    if (field.empty() || field == "keyvalue") {
      refuse_.damaged("a field of its header", "'" + printable(name) + "'",
                      "which the format does not have");
    }
    const std::string_view value = trimmed(line.substr(colon + 1));
    if (!fields_.emplace(std::string(field), value).second) {
      refuse_.damaged(field, "there twice", "one of the two is wrong");
    }
  }

  [[nodiscard]] std::string_view optional(const char* field) const {
    const auto found = fields_.find(field);
    return found == fields_.end() ? std::string_view{} : found->second;
  }
  [[nodiscard]] std::string_view needed(const char* field) const {
    const std::string_view value = optional(field);
    if (value.empty()) refuse_.damaged(field, "missing", "its header needs it");
    return value;
  }

  void take_type(VolumeHeader& header) const {
    const std::string type = lower(needed("type"));
    const auto* known = std::find_if(kTypes.begin(), kTypes.end(), [&](const KnownType& k) {
      return k.names.find("," + type + ",") != std::string_view::npos;
    });
    if (known == kTypes.end() || type.find(',') != std::string::npos) {
      refuse_.unusable("type", "'" + printable(type) + "'",
                       "convert it to 16-bit integers and open it again");
    }
    header.type = known->type;
    const std::string endian = lower(optional("endian"));
    if (endian != "little" && endian != "big" && (!endian.empty() || size_of(header.type) > 1)) {
      refuse_.damaged("endian", "'" + printable(endian) + "'", "which must be little or big");
    }
    header.is_big_endian = endian == "big";
  }

  void take_storage(VolumeHeader& header) const {
    take_type(header);
    const std::string encoding = lower(needed("encoding"));
    if (encoding != "raw" && encoding != "gzip" && encoding != "gz") {
      refuse_.unusable("encoding", "'" + printable(encoding) + "'",
                       "save it with encoding raw or gzip and open that");
    }
    header.packing = encoding == "raw" ? Packing::Raw : Packing::Gzip;
    header.data_file = optional("data file");
    if (header.data_file.empty()) {
      header.stored_begins = header_bytes_;
    } else if (!is_plain_file_name(header.data_file) || words_of(header.data_file).size() != 1 ||
               lower(header.data_file) == "list" ||
               header.data_file.find('%') != std::string::npos) {
      refuse_.unusable(
          "data file", "'" + printable(header.data_file) + "'",
          "only the name of one file in the same folder is read; save it as one .nrrd");
    }
    if (const std::string_view lines = optional("line skip"); !lines.empty() && lines != "0") {
      refuse_.unusable("line skip", printable(lines), "save it without and open that");
    }
    const std::string_view skip = optional("byte skip");
    const auto bytes = integer_of(skip.empty() ? "0" : skip);
    if (!bytes || *bytes < -1 || (*bytes != 0 && header.packing != Packing::Raw)) {
      refuse_.unusable("byte skip", "'" + printable(skip) + "'", "save it without and open that");
    }
    header.lies_at_end = *bytes == -1;
    if (*bytes > 0) header.stored_begins += static_cast<std::uint64_t>(*bytes);
    if (header.lies_at_end && header.data_file.empty()) {
      refuse_.unusable("byte skip", "-1", "save it without and open that");
    }
  }

  [[nodiscard]] std::string space_without_case() const {
    std::string space = lower(needed("space"));
    if (space == "lps") return "left-posterior-superior";
    if (space == "ras") return "right-anterior-superior";
    if (space == "las") return "left-anterior-superior";
    return space;
  }

  /// "(1,0,0)"
  [[nodiscard]] Vec3 vector(std::string_view text, const char* field) const {
    std::array<double, 3> v{};
    const bool is_bracketed = text.size() > 2 && text.front() == '(' && text.back() == ')';
    std::string_view rest = is_bracketed ? text.substr(1, text.size() - 2) : std::string_view{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t comma = i < 2 ? rest.find(',') : rest.size();
      const auto number = comma == std::string_view::npos
                              ? std::nullopt
                              : number_of(trimmed(rest.substr(0, comma)));
      if (!number) {
        refuse_.damaged(field, "'" + printable(text) + "'", "where (x,y,z) is needed");
      }
      v[i] = *number;
      rest = i < 2 ? rest.substr(comma + 1) : std::string_view{};
    }
    return {v[0], v[1], v[2]};
  }

  /// Vectors between blanks; blanks inside the brackets are allowed too.
  [[nodiscard]] std::vector<Vec3> vectors(std::string_view text, const char* field) const {
    std::vector<Vec3> all;
    for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
      const std::size_t end = std::min(text.find(')'), text.size() - 1);
      all.push_back(vector(text.substr(0, end + 1), field));
      text = text.substr(end + 1);
      if (all.size() > 3) break;
    }
    return all;
  }

  void check_axes() const {
    const auto dimension = integer_of(needed("dimension"));
    if (!dimension || *dimension != 3) {
      refuse_.unusable("dimension", printable(needed("dimension")),
                       "a CT has 3 axes; save one time point as a volume and open that");
    }
    for (const std::string_view kind : words_of(optional("kinds"))) {
      const std::string k = lower(kind);
      if (k != "domain" && k != "space" && k != "???" && k != "none") {
        refuse_.unusable("kinds", "'" + printable(kind) + "'",
                         "a CT has three axes of space and one number a voxel");
      }
    }
    if (const std::string_view units = optional("space units"); !units.empty()) {
      std::string_view rest = units;
      for (int i = 0; i < 3; ++i) {
        rest = trimmed(rest);
        if (rest.starts_with("\"mm\"")) {
          rest = rest.substr(4);
        } else {
          refuse_.unusable("space units", printable(units), "save it in \"mm\" and open that");
        }
      }
    }
    if (const std::string_view n = optional("space dimension"); !n.empty() && n != "3") {
      refuse_.damaged("space dimension", printable(n), "which must be 3");
    }
  }

  GridGeometry geometry(VolumeHeader& header) const {
    check_axes();
    StatedGeometry stated;
    const std::vector<double> sizes = numbers_of(needed("sizes"), 3);
    if (sizes.empty())
      refuse_.damaged("sizes", "'" + printable(needed("sizes")) + "'", "not three");
    std::copy(sizes.begin(), sizes.end(), stated.size.begin());
    const std::vector<Vec3> directions = vectors(needed("space directions"), "space directions");
    if (directions.size() != 3) {
      refuse_.damaged("space directions", std::to_string(directions.size()), "not three");
    }
    const std::string_view origin = optional("space origin");
    if (origin.empty()) {
      header.conventions.emplace_back("the first voxel lies at 0, 0, 0 (no space origin is said)");
    } else {
      stated.origin = vector(origin, "space origin");
    }
    const std::string space = space_without_case();
    Vec3 sign{1, 1, 1};
    if (space == "right-anterior-superior") sign = {-1, -1, 1};
    if (space == "left-anterior-superior") sign = {1, -1, 1};
    if (space != "left-posterior-superior" && sign == Vec3{1, 1, 1}) {
      refuse_.unusable("space", "'" + printable(space) + "', so left and right are not known",
                       "save it in left-posterior-superior and open that");
    }
    for (std::size_t i = 0; i < 3; ++i) {
      Vec3 axis = directions[i];
      for (std::size_t k = 0; k < 3; ++k) axis[k] *= sign[k];
      stated.origin[i] *= sign[i];
      stated.spacing[i] = length(axis);
      stated.axes[i] = normalized_or(axis, {0, 0, 0});
    }
    check_spacings(stated.spacing);
    return usable_geometry(stated, refuse_);
  }

  void check_spacings(const Vec3& found) const {
    const std::string_view text = optional("spacings");
    if (text.empty()) return;
    const std::vector<double> spacings = numbers_of(text, 3);
    for (std::size_t i = 0; i < 3; ++i) {
      constexpr double kSameRatio = 2e-4;
      if (spacings.empty() || !(std::abs(spacings[i] - found[i]) <= kSameRatio * found[i])) {
        refuse_.damaged("spacings", "'" + printable(text) + "'", "but space directions say others");
      }
    }
  }

  std::string_view front_;
  const Refuser& refuse_;
  std::map<std::string, std::string_view, std::less<>> fields_;
  std::string description_;
  std::size_t header_bytes_ = 0;
};

}  // namespace

VolumeHeader parse_nrrd(std::string_view front, const Refuser& refuse) {
  return Parser(front, refuse).run();
}

}  // namespace carpus::image_formats
