// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/detail/volume_file.hpp"

#include <itkIOCommon.h>
#include <itkMetaDataObject.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>
#include <itkObject.h>

#include <algorithm>
#include <string>

#include "case_io/detail/meta_image_check.hpp"
#include "case_io/detail/nifti_check.hpp"
#include "case_io/detail/nifti_description.hpp"
#include "core/error.hpp"

namespace carpus::case_io {
namespace fs = std::filesystem;
namespace {

bool ends_with(const fs::path& file, std::string_view ending) {
  std::string name = file.filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return std::string_view(name).ends_with(ending);
}

bool is_nifti(const fs::path& file) {
  return ends_with(file, ".nii") || ends_with(file, ".nii.gz");
}

itk::ImageIOBase::Pointer volume_reader_for(const fs::path& file) {
  if (is_nifti(file)) return itk::NiftiImageIO::New().GetPointer();
  if (ends_with(file, ".nrrd") || ends_with(file, ".nhdr"))
    return itk::NrrdImageIO::New().GetPointer();
  if (ends_with(file, ".mha") || ends_with(file, ".mhd"))
    return itk::MetaImageIO::New().GetPointer();
  return nullptr;
}

}  // namespace

bool is_volume_file(const fs::path& file) { return volume_reader_for(file).IsNotNull(); }

std::string description_of_volume_file(const fs::path& file) {
  if (is_nifti(file)) return read_nifti_description(file);
  itk::Object::SetGlobalWarningDisplay(false);
  const itk::ImageIOBase::Pointer io = volume_reader_for(file);
  std::string description;
  if (!io) return description;
  try {
    io->SetFileName(file.string());
    io->ReadImageInformation();
    itk::ExposeMetaData(io->GetMetaDataDictionary(), itk::ITK_FileNotes, description);
  } catch (const itk::ExceptionObject&) {
    // Whoever reads the volume is told what is wrong with it.
  }
  return description;
}

template <typename T>
Grid<T> read_volume_file(const fs::path& file, ValueCount& count) {
  itk::Object::SetGlobalWarningDisplay(false);  // our messages say what to do
  const itk::ImageIOBase::Pointer io = volume_reader_for(file);
  if (!io) {
    throw InvalidInput(file.string() + ": is none of the formats this program reads: " +
                       std::string(kKnownFormats) + "; convert it and open the result");
  }
  if (is_nifti(file)) check_nifti_is_whole(file);
  const GridGeometry geometry = read_geometry(*io, file);
  if (ends_with(file, ".mha") || ends_with(file, ".mhd")) {
    check_meta_image_is_whole(file, static_cast<std::uintmax_t>(io->GetImageSizeInBytes()));
  }
  Grid<T> grid(geometry);
  read_values<T>(*io, file, grid.values(), count);
  return grid;
}

template Grid<std::int16_t> read_volume_file(const fs::path&, ValueCount&);
template Grid<std::uint8_t> read_volume_file(const fs::path&, ValueCount&);
template Grid<float> read_volume_file(const fs::path&, ValueCount&);

}  // namespace carpus::case_io
