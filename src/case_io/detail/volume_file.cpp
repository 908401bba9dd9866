// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. The header, by our own parser of its format, and where the voxels lie.
// 2. Their length against what the header needs, and that against memory, before any is asked for.
// 3. A child unpacks and converts them into shared memory, checksums and lengths enforced.
#include "case_io/detail/volume_file.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "case_io/detail/disposable_child.hpp"
#include "case_io/detail/memory_room.hpp"
#include "case_io/detail/regular_file.hpp"
#include "case_io/detail/shared_array.hpp"
#include "case_io/detail/unpacking.hpp"
#include "core/error.hpp"
#include "image_formats/header_text.hpp"
#include "image_formats/meta_image_header.hpp"
#include "image_formats/nifti_header.hpp"
#include "image_formats/nrrd_header.hpp"

namespace carpus::case_io {
namespace fs = std::filesystem;
namespace {

using image_formats::Packing;
using image_formats::Refuser;
using image_formats::VolumeHeader;

/// What a child needs beside the voxels: a block, zlib's window, the messages.
constexpr std::uint64_t kWorkingBytes = std::uint64_t{64} << 20U;

enum class Format { None, Nifti, Nrrd, MetaImage };

Format format_of(const fs::path& file) {
  const std::string name = image_formats::lower(file.filename().string());
  const auto ends_with = [&](std::string_view ending) { return name.ends_with(ending); };
  if (ends_with(".nii") || ends_with(".nii.gz")) return Format::Nifti;
  if (ends_with(".nrrd") || ends_with(".nhdr")) return Format::Nrrd;
  if (ends_with(".mha") || ends_with(".mhd")) return Format::MetaImage;
  return Format::None;
}

VolumeHeader nifti_header(FileBytes& bytes, const Refuser& refuse) {
  std::vector<std::byte> front(static_cast<std::size_t>(
      std::min<std::uint64_t>(image_formats::kNiftiFrontBytes, bytes.size())));
  if (!bytes.read(0, front)) refuse.damaged("the file", "not readable", "check the disk");
  const bool is_packed =
      front.size() >= 2 && front[0] == std::byte{0x1F} && front[1] == std::byte{0x8B};
  if (!is_packed) return image_formats::parse_nifti(front, refuse);
  front = unpack_front(bytes, image_formats::kNiftiFrontBytes, refuse);
  VolumeHeader header = image_formats::parse_nifti(front, refuse);
  header.packing = Packing::Gzip;
  header.unpacked_skip = std::exchange(header.stored_begins, 0);
  return header;
}

VolumeHeader header_of(const RegularFile& file, Format format, const Refuser& refuse) {
  FileBytes bytes(file);
  if (format == Format::Nifti) return nifti_header(bytes, refuse);
  std::string front(static_cast<std::size_t>(
                        std::min<std::uint64_t>(image_formats::kLongestHeaderText, bytes.size())),
                    '\0');
  if (!bytes.read(0, std::as_writable_bytes(std::span(front)))) {
    refuse.damaged("the file", "not readable", "check the disk");
  }
  return format == Format::Nrrd ? image_formats::parse_nrrd(front, refuse)
                                : image_formats::parse_meta_image(front, refuse);
}

/// The part of `holder` that holds the voxels, as stored.
image_formats::ByteRange stored_range(const VolumeHeader& header,
                                      const RegularFile& holder,
                                      const Refuser& refuse) {
  const std::uint64_t size = holder.size();
  const std::uint64_t needed = header.voxel_bytes();
  if (header.lies_at_end && size >= needed) return {size - needed, needed};
  const std::uint64_t there = size > header.stored_begins ? size - header.stored_begins : 0;
  if (header.packing == Packing::Raw && there != needed) {
    refuse.damaged("its voxel data", std::to_string(there) + " bytes",
                   "but its header needs " + std::to_string(needed) +
                       (there < needed ? ", so that it is cut short" : ""));
  }
  if (header.packing != Packing::Raw) {
    if (header.packed_bytes && *header.packed_bytes != there) {
      refuse.damaged("CompressedDataSize", std::to_string(*header.packed_bytes),
                     "but " + std::to_string(there) + " bytes are there");
    }
    check_packed_size(there, header.unpacked_skip + needed, refuse);
  }
  return {header.stored_begins, there};
}

template <typename T>
Grid<T> decode(const VolumeHeader& header,
               const RegularFile& holder,
               const Refuser& refuse,
               ValueCount& count) {
  const image_formats::ByteRange range = stored_range(header, holder, refuse);
  const std::size_t voxels = header.geometry.voxel_count();
  require_memory(voxels * sizeof(T) + kWorkingBytes, refuse.file());
  const MappedFile mapped(holder);
  const auto stored = mapped.bytes().subspan(static_cast<std::size_t>(range.begins),
                                             static_cast<std::size_t>(range.bytes));
  SharedArray<T> values(voxels);
  SharedArray<ValueCount> counted(1);
  const std::uint64_t total = header.unpacked_skip + header.voxel_bytes();
  ChildTask task;
  task.subject = [&](std::uint64_t) { return refuse.file(); };
  task.heap_bytes = kWorkingBytes;
  task.deadline = time_for(total);
  task.work = [&](std::atomic<std::uint64_t>&) {
    ValueCount local;
    VoxelWriter<T> writer(header, values.values(), local);
    unpack(stored, header.packing, total, refuse,
           [&](std::span<const std::byte> bytes) { writer.put(bytes); });
    counted.values()[0] = local;
  };
  run_in_child(task);
  count = counted.values()[0];
  return Grid<T>(header.geometry, values.take());
}

}  // namespace

bool is_volume_file(const fs::path& file) { return format_of(file) != Format::None; }

std::string description_of_volume_file(const fs::path& file) {
  const Format format = format_of(file);
  if (format == Format::None) return {};
  try {
    return header_of(RegularFile(file), format, Refuser(file.string())).description;
  } catch (const Error&) {
    return {};  // whoever reads the volume is told what is wrong with it
  }
}

template <typename T>
Grid<T> read_volume_file(const fs::path& file, ReadingNotes& notes) {
  const Format format = format_of(file);
  if (format == Format::None) {
    throw InvalidInput(file.string() + ": is none of the formats this program reads: " +
                       std::string(kKnownFormats) + "; convert it and open the result");
  }
  const Refuser refuse(file.string());
  const RegularFile opened(file);
  const VolumeHeader header = header_of(opened, format, refuse);
  notes.conventions = header.conventions;
  if (header.data_file.empty()) return decode<T>(header, opened, refuse, notes.count);
  const fs::path beside = file.parent_path() / header.data_file;
  if (!fs::exists(fs::symlink_status(beside))) {
    throw IoError(file.string() + ": its voxels in '" + image_formats::printable(header.data_file) +
                  "' are not there; copy that file again beside this one");
  }
  return decode<T>(header, RegularFile(beside, Links::Refuse), Refuser(beside.string()),
                   notes.count);
}

template Grid<std::int16_t> read_volume_file(const fs::path&, ReadingNotes&);
template Grid<std::uint8_t> read_volume_file(const fs::path&, ReadingNotes&);
template Grid<float> read_volume_file(const fs::path&, ReadingNotes&);

}  // namespace carpus::case_io
