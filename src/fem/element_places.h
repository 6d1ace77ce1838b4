// Where rows and columns of an element's tangent stand in the matrix of the unknowns that it couples.
#pragma once
#include "fem/discretisation.h"

namespace rheocyte {

struct ElementPlaces {
  std::vector<int> row, column;  ///< by slots; -1: not in the matrix

  /// `order` lists the unknowns of the matrix, out of so many.
  ElementPlaces(const ElementUnknowns& element, const std::vector<int>& order, int unknowns) {
    std::vector<int> place(unknowns, -1);
    for (int i = 0; i < int(order.size()); ++i) place[order[i]] = i;
    for (const int unknown : element.rows) row.push_back(unknown < 0 ? -1 : place[unknown]);
    for (const Slot& slot : element.columns) column.push_back(slot.unknown < 0 ? -1 : place[slot.unknown]);
  }

  void add(const ElementUnknowns& element, const MatrixXd& tangent, MatrixXd& matrix) const {
    for (int j = 0; j < int(column.size()); ++j) {
      if (column[j] < 0) continue;
      const double factor = element.columns[j].factor;
      for (int i = 0; i < int(row.size()); ++i) {
        if (row[i] >= 0) matrix(row[i], column[j]) += factor * tangent(i, j);
      }
    }
  }
};

}  // namespace rheocyte
