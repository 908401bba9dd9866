// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Rows enter one after another. For each, a shortest path over reduced costs is grown from it to
// the first free column (Dijkstra with potentials), and the assignments along it are shifted.
#include "anatomy/assignment.hpp"

#include <limits>

#include "core/check.hpp"

namespace carpus::anatomy {
namespace {

class Assigner {
 public:
  Assigner(std::span<const double> costs, std::size_t rows, std::size_t columns)
      : costs_(costs),
        columns_(columns),
        row_potential_(rows + 1, 0.0),
        column_potential_(columns + 1, 0.0),
        row_of_(columns + 1, 0),
        from_(columns + 1, 0) {}

  /// Rows and columns count from 1 here; column 0 stands for the row that is to be placed.
  void place(std::size_t row) {
    row_of_[0] = row;
    std::vector<double> distance(columns_ + 1, std::numeric_limits<double>::infinity());
    std::vector<bool> settled(columns_ + 1, false);
    std::size_t column = 0;
    do {
      settled[column] = true;
      column = step_from(column, distance, settled);
    } while (row_of_[column] != 0);
    while (column != 0) {
      row_of_[column] = row_of_[from_[column]];
      column = from_[column];
    }
  }

  [[nodiscard]] std::vector<std::size_t> columns_of_rows() const {
    std::vector<std::size_t> result(row_potential_.size() - 1);
    for (std::size_t j = 1; j <= columns_; ++j) {
      if (row_of_[j] != 0) result[row_of_[j] - 1] = j - 1;
    }
    return result;
  }

 private:
  std::size_t step_from(std::size_t column,
                        std::vector<double>& distance,
                        const std::vector<bool>& settled) {
    const std::size_t i = row_of_[column];
    double delta = std::numeric_limits<double>::infinity();
    std::size_t nearest = 0;
    for (std::size_t j = 1; j <= columns_; ++j) {
      if (settled[j]) continue;
      const double reduced =
          costs_[(i - 1) * columns_ + (j - 1)] - row_potential_[i] - column_potential_[j];
      if (reduced < distance[j]) {
        distance[j] = reduced;
        from_[j] = column;
      }
      if (distance[j] < delta) {
        delta = distance[j];
        nearest = j;
      }
    }
    for (std::size_t j = 0; j <= columns_; ++j) {
      if (settled[j]) {
        row_potential_[row_of_[j]] += delta;
        column_potential_[j] -= delta;
      } else {
        distance[j] -= delta;
      }
    }
    return nearest;
  }

  std::span<const double> costs_;
  std::size_t columns_;
  std::vector<double> row_potential_;
  std::vector<double> column_potential_;
  std::vector<std::size_t> row_of_;  ///< [column], 0 = free
  std::vector<std::size_t> from_;    ///< [column] before it on the path
};

}  // namespace

std::vector<std::size_t> assign_at_least_cost(std::span<const double> costs,
                                              std::size_t rows,
                                              std::size_t columns) {
  CARPUS_CHECK(rows <= columns && costs.size() == rows * columns);
  Assigner assigner(costs, rows, columns);
  for (std::size_t row = 1; row <= rows; ++row) assigner.place(row);
  return assigner.columns_of_rows();
}

}  // namespace carpus::anatomy
