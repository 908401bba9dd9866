// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/write_volume.hpp"

#include <itkIOCommon.h>
#include <itkMetaDataObject.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>
#include <type_traits>

#include "case_io/detail/disk_space.hpp"
#include "case_io/detail/nifti_copy.hpp"
#include "case_io/detail/volume_file.hpp"
#include "core/error.hpp"

namespace carpus::case_io {
namespace fs = std::filesystem;
namespace {

bool is_nifti(const fs::path& file) {
  const std::string name = file.string();
  return name.ends_with(".nii") || name.ends_with(".nii.gz");
}

itk::ImageIOBase::Pointer volume_writer_for(const std::string& name) {
  const std::string_view n = name;
  if (is_nifti(name)) return itk::NiftiImageIO::New().GetPointer();
  if (n.ends_with(".nrrd")) return itk::NrrdImageIO::New().GetPointer();
  if (n.ends_with(".mha")) return itk::MetaImageIO::New().GetPointer();
  return nullptr;
}

template <typename T>
constexpr itk::IOComponentEnum component_of() {
  if (std::is_same_v<T, std::int16_t>) return itk::IOComponentEnum::SHORT;
  if (std::is_same_v<T, std::uint8_t>) return itk::IOComponentEnum::UCHAR;
  return itk::IOComponentEnum::FLOAT;
}

template <typename T>
void describe(itk::ImageIOBase& io, const GridGeometry& g) {
  io.SetNumberOfDimensions(3);
  itk::ImageIORegion region(3);
  for (unsigned i = 0; i < 3; ++i) {
    const Vec3 axis = g.direction.column(i);
    io.SetDimensions(i, static_cast<itk::SizeValueType>(g.size[i]));
    io.SetSpacing(i, g.spacing[i]);
    io.SetOrigin(i, g.origin[i]);
    io.SetDirection(i, std::vector<double>{axis.x, axis.y, axis.z});
    region.SetIndex(i, 0);
    region.SetSize(i, static_cast<itk::SizeValueType>(g.size[i]));
  }
  io.SetIORegion(region);
  io.SetNumberOfComponents(1);
  io.SetPixelType(itk::IOPixelEnum::SCALAR);
  io.SetComponentType(component_of<T>());
}

template <typename T>
void require_reads_back(const fs::path& file, const GridView<const T>& volume) {
  std::string difference = "it holds other values";
  try {
    ReadingNotes notes;
    const Grid<T> read = read_volume_file<T>(file, notes);
    if (read.geometry().size == volume.geometry().size &&
        std::equal(read.values().begin(), read.values().end(), volume.values().begin())) {
      return;
    }
  } catch (const Error& error) {
    difference = error.what();
  }
  throw_cannot_write(file, difference);
}

template <typename T>
void write_by_itk(const fs::path& file,
                  const GridView<const T>& volume,
                  const std::string& description) {
  require_volume_name(file);
  const itk::ImageIOBase::Pointer io = volume_writer_for(file.string());
  try {
    io->SetFileName(file.string());
    describe<T>(*io, volume.geometry());
    if (!description.empty()) {
      itk::EncapsulateMetaData(io->GetMetaDataDictionary(), itk::ITK_FileNotes, description);
    }
    io->SetUseCompression(false);
    io->Write(volume.values().data());
  } catch (const itk::ExceptionObject&) {
    throw_cannot_write(file);
  }
}

/// By way of a file beside it, which vanishes.
template <typename T>
void write_nifti(const fs::path& file,
                 const GridView<const T>& volume,
                 const std::string& description) {
  struct Plain {
    fs::path file;
    ~Plain() {
      std::error_code ignored;
      fs::remove(file, ignored);
    }
  };
  const Plain first{file.parent_path() / ("plain_" + file.stem().stem().string() + ".nii")};
  write_by_itk(first.file, volume, {});
  copy_nifti(first.file, file, description);
}

}  // namespace

void require_volume_name(const fs::path& file) {
  if (volume_writer_for(file.string()) != nullptr) return;
  throw InvalidInput(file.string() +
                     ": has no ending that volumes are written to (.nii.gz, .nrrd, .mha)");
}

template <typename T>
void write_volume(const fs::path& file,
                  const GridView<const T>& volume,
                  const std::string& description) {
  itk::Object::SetGlobalWarningDisplay(false);
  if (is_nifti(file)) {
    write_nifti(file, volume, description);
  } else {
    write_by_itk(file, volume, description);
  }
  require_reads_back(file, volume);
}

template void write_volume(const fs::path&,
                           const GridView<const std::int16_t>&,
                           const std::string&);
template void write_volume(const fs::path&,
                           const GridView<const std::uint8_t>&,
                           const std::string&);
template void write_volume(const fs::path&, const GridView<const float>&, const std::string&);

}  // namespace carpus::case_io
