#include "fem/sparse_lu.h"

#include <cblas.h>
#include <umfpack.h>

#include <algorithm>
#include <cassert>

namespace rheocyte {

SparseMatrix::SparseMatrix(int n, std::vector<std::pair<int, int>> entries) : size(n) {
  std::sort(entries.begin(), entries.end(),
            [](const auto& a, const auto& b) { return std::pair(a.second, a.first) < std::pair(b.second, b.first); });
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
  column_start.assign(n + 1, 0);
  for (const auto& [i, j] : entries) {
    row.push_back(i);
    ++column_start[j + 1];
  }
  for (int j = 0; j < n; ++j) column_start[j + 1] += column_start[j];
  value.assign(entries.size(), 0.0);
}

int SparseMatrix::position(int i, int j) const {
  const auto first = row.begin() + column_start[j], last = row.begin() + column_start[j + 1];
  const auto it = std::lower_bound(first, last, i);
  assert(it != last && *it == i);
  return int(it - row.begin());
}

struct SparseLU::Umfpack {
  void* symbolic = nullptr;
  void* numeric = nullptr;
  double control[UMFPACK_CONTROL];
  mutable double info[UMFPACK_INFO];

  ~Umfpack() {
    umfpack_di_free_symbolic(&symbolic);
    umfpack_di_free_numeric(&numeric);
  }
};

SparseLU::SparseLU(const SparseMatrix& matrix) : matrix_(matrix), umfpack_(std::make_unique<Umfpack>()) {
  // Several threads would slow the small dense kernels, and change bits.
  [[maybe_unused]] static const bool single = (openblas_set_num_threads(1), true);
  umfpack_di_defaults(umfpack_->control);
  umfpack_->control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
  umfpack_->control[UMFPACK_IRSTEP] = 1;
  umfpack_di_symbolic(matrix.size, matrix.size, matrix.column_start.data(), matrix.row.data(), nullptr,
                      &umfpack_->symbolic, umfpack_->control, umfpack_->info);
}

SparseLU::~SparseLU() = default;

bool SparseLU::factorise() {
  umfpack_di_free_numeric(&umfpack_->numeric);
  const auto finite = [](double v) { return std::isfinite(v); };
  if (!umfpack_->symbolic || !std::all_of(matrix_.value.begin(), matrix_.value.end(), finite)) return false;
  const int status = umfpack_di_numeric(matrix_.column_start.data(), matrix_.row.data(), matrix_.value.data(),
                                        umfpack_->symbolic, &umfpack_->numeric, umfpack_->control, umfpack_->info);
  flops_ = umfpack_->info[UMFPACK_FLOPS];
  entries_ = umfpack_->info[UMFPACK_LNZ] + umfpack_->info[UMFPACK_UNZ];
  return status == UMFPACK_OK;
}

Eigen::VectorXd SparseLU::solve(const Eigen::VectorXd& rhs) const {
  Eigen::VectorXd x(matrix_.size);
  umfpack_di_solve(UMFPACK_A, matrix_.column_start.data(), matrix_.row.data(), matrix_.value.data(), x.data(),
                   rhs.data(), umfpack_->numeric, umfpack_->control, umfpack_->info);
  return x;
}

}  // namespace rheocyte
