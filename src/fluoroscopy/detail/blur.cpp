// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "fluoroscopy/detail/blur.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/parallel.hpp"

namespace carpus::fluoroscopy::detail {
namespace {

constexpr std::size_t kRowGrain = 16;
constexpr double kLeastSigmaPx = 0.1;
constexpr int kCoarse = 8;  ///< side of the squares that blur_wide averages [pixels]

std::vector<float> half_kernel(double sigma_px) {
  const int reach = static_cast<int>(std::ceil(3 * sigma_px));
  std::vector<float> kernel;
  double sum = 0;
  for (int i = 0; i <= reach; ++i) {
    const double weight = std::exp(-0.5 * i * i / (sigma_px * sigma_px));
    kernel.push_back(static_cast<float>(weight));
    sum += i == 0 ? weight : 2 * weight;
  }
  for (float& weight : kernel) weight /= static_cast<float>(sum);
  return kernel;
}

/// Smooths along rows and writes the result transposed, so that two passes do both directions.
std::vector<float> smooth_and_transpose(const std::vector<float>& picture,
                                        int width,
                                        int height,
                                        const std::vector<float>& kernel) {
  std::vector<float> result(picture.size());
  const int reach = static_cast<int>(kernel.size()) - 1;
  const auto body = [&](std::size_t from, std::size_t to) {
    std::vector<float> padded(static_cast<std::size_t>(width) +
                              2 * static_cast<std::size_t>(reach));
    for (std::size_t j = from; j < to; ++j) {
      const float* const row = picture.data() + j * static_cast<std::size_t>(width);
      for (std::size_t i = 0; i < padded.size(); ++i) {
        padded[i] = row[std::clamp(static_cast<int>(i) - reach, 0, width - 1)];
      }
      for (int i = 0; i < width; ++i) {
        const float* const centre = padded.data() + i + reach;
        float sum = kernel[0] * centre[0];
        for (int k = 1; k <= reach; ++k) {
          sum += kernel[static_cast<std::size_t>(k)] * (centre[-k] + centre[k]);
        }
        result[static_cast<std::size_t>(i) * static_cast<std::size_t>(height) + j] = sum;
      }
    }
  };
  parallel_for(static_cast<std::size_t>(height), kRowGrain, body);
  return result;
}

}  // namespace

std::vector<float> blur_gaussian(const std::vector<float>& picture,
                                 int width,
                                 int height,
                                 double sigma_px) {
  if (!(sigma_px >= kLeastSigmaPx) || picture.empty()) return picture;
  const std::vector<float> kernel = half_kernel(sigma_px);
  return smooth_and_transpose(smooth_and_transpose(picture, width, height, kernel), height, width,
                              kernel);
}

std::vector<float> blur_wide(const std::vector<float>& picture,
                             int width,
                             int height,
                             double sigma_px) {
  if (picture.empty()) return picture;
  const int coarse_width = (width + kCoarse - 1) / kCoarse;
  const int coarse_height = (height + kCoarse - 1) / kCoarse;
  const auto at = [](int i, int j, int row) {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(row) +
           static_cast<std::size_t>(i);
  };
  std::vector<float> coarse(at(0, coarse_height, coarse_width));
  for (int j = 0; j < coarse_height; ++j) {
    for (int i = 0; i < coarse_width; ++i) {
      float sum = 0.0F;
      int count = 0;
      for (int y = j * kCoarse; y < std::min(height, (j + 1) * kCoarse); ++y) {
        for (int x = i * kCoarse; x < std::min(width, (i + 1) * kCoarse); ++x, ++count) {
          sum += picture[at(x, y, width)];
        }
      }
      coarse[at(i, j, coarse_width)] = sum / static_cast<float>(count);
    }
  }
  coarse = blur_gaussian(coarse, coarse_width, coarse_height, sigma_px / kCoarse);
  std::vector<float> result(picture.size());
  for (int y = 0; y < height; ++y) {
    const float v = std::clamp((static_cast<float>(y) + 0.5F) / kCoarse - 0.5F, 0.0F,
                               static_cast<float>(coarse_height - 1));
    const int j = std::min(static_cast<int>(v), std::max(0, coarse_height - 2));
    const int next_j = std::min(j + 1, coarse_height - 1);
    const float fv = v - static_cast<float>(j);
    for (int x = 0; x < width; ++x) {
      const float u = std::clamp((static_cast<float>(x) + 0.5F) / kCoarse - 0.5F, 0.0F,
                                 static_cast<float>(coarse_width - 1));
      const int i = std::min(static_cast<int>(u), std::max(0, coarse_width - 2));
      const int next_i = std::min(i + 1, coarse_width - 1);
      const float fu = u - static_cast<float>(i);
      const auto row = [&](int r) {
        return coarse[at(i, r, coarse_width)] * (1 - fu) + coarse[at(next_i, r, coarse_width)] * fu;
      };
      result[at(x, y, width)] = row(j) * (1 - fv) + row(next_j) * fv;
    }
  }
  return result;
}

}  // namespace carpus::fluoroscopy::detail
