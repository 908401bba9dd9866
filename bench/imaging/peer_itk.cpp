// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// ITK's watershed from markers and recursive Gaussian gradient, on one thread.
#include <itkGradientMagnitudeRecursiveGaussianImageFilter.h>
#include <itkImportImageFilter.h>
#include <itkMorphologicalWatershedFromMarkersImageFilter.h>
#include <itkMultiThreaderBase.h>

#include "bench/imaging/engines.hpp"

namespace carpus::bench {
namespace {

template <typename T>
typename itk::Image<T, 3>::Pointer image_of(const Volume& volume, const std::vector<T>& values) {
  itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(1);
  using Import = itk::ImportImageFilter<T, 3>;
  const auto import = Import::New();
  typename Import::SizeType size;
  typename Import::RegionType region;
  for (unsigned a = 0; a < 3; ++a) size[a] = static_cast<itk::SizeValueType>(volume.size[a]);
  region.SetSize(size);
  import->SetRegion(region);
  import->SetSpacing(volume.spacing_mm.data());
  // Read only: neither filter runs in place over what it is given here.
  import->SetImportPointer(const_cast<T*>(values.data()), values.size(), false);
  import->Update();
  return import->GetOutput();
}

template <typename Relief>
WatershedRun run_watershed(const Volume& volume,
                           const std::vector<Relief>& relief,
                           const std::vector<std::uint16_t>& markers) {
  using ReliefImage = itk::Image<Relief, 3>;
  using LabelImage = itk::Image<std::uint16_t, 3>;
  const auto input = image_of<Relief>(volume, relief);
  const auto marked = image_of<std::uint16_t>(volume, markers);
  WatershedRun run;
  const double start = processor_seconds();
  const auto filter =
      itk::MorphologicalWatershedFromMarkersImageFilter<ReliefImage, LabelImage>::New();
  filter->SetInput1(input);
  filter->SetInput2(marked);
  filter->SetMarkWatershedLine(false);
  filter->SetFullyConnected(false);
  filter->Update();
  run.seconds = processor_seconds() - start;
  const std::uint16_t* labels = filter->GetOutput()->GetBufferPointer();
  run.labels.assign(labels, labels + volume.voxels());
  return run;
}

}  // namespace

WatershedRun run_itk_watershed(const Volume& volume, const std::vector<std::uint16_t>& markers) {
  return run_watershed<float>(volume, volume.relief, markers);
}

WatershedRun run_itk_12bit_watershed(const Volume& volume,
                                     const std::vector<std::uint16_t>& markers) {
  return run_watershed<std::uint16_t>(volume, volume.relief_12, markers);
}

GradientRun run_itk_gradient(const Volume& volume, double sigma_mm) {
  using FloatImage = itk::Image<float, 3>;
  const auto input = image_of<float>(volume, volume.hu);
  GradientRun run;
  const double start = processor_seconds();
  const auto filter =
      itk::GradientMagnitudeRecursiveGaussianImageFilter<FloatImage, FloatImage>::New();
  filter->SetInput(input);
  filter->SetSigma(sigma_mm);
  filter->Update();
  run.seconds = processor_seconds() - start;
  const float* values = filter->GetOutput()->GetBufferPointer();
  run.values.assign(values, values + volume.voxels());
  return run;
}

}  // namespace carpus::bench
