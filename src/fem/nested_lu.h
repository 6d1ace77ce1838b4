// Direct solution of a finite-element system by condensing ever larger subdomains: elements are joined in pairs,
// pairs in pairs, and each time all unknowns that no other element knows are eliminated from a dense matrix
// (docs/theory-square.md, eq:nested). With 50 to 150 elements of high degree the faces between subdomains are large
// dense blocks by themselves, so that no ordering of single unknowns could do better, and no library is needed.
//
// Matrices and factors may have single precision, which halves memory and time: they only correct a state, and Newton's
// method, whose residuals have double precision, goes on with the same factors until nothing is left to correct.
#pragma once
#include <Eigen/LU>
#include <array>
#include <atomic>
#include <vector>

namespace rheocyte {

/// What couples in an element. Unknowns and equations share their numbers.
struct CoupledUnknowns {
  std::vector<int> unknowns;
  /// The constant pressure, -1 if there is none: it and the motion of the faces inside a subdomain determine each other
  /// but for one pressure, which stays until the subdomain has grown.
  int pressure = -1;
  int medium = 0;               ///< pressures of neighbours are determined together where they have the same one
  std::vector<int> neighbours;  ///< elements that share a face
};

/// Sets the neighbours of elements with these nodes, where a face has so many.
void set_neighbours(std::vector<std::vector<int>> nodes, std::size_t nodes_of_face, std::vector<CoupledUnknowns>&);

template <class Scalar>
class NestedLU {
 public:
  using Matrix = Eigen::MatrixX<Scalar>;

  /// Chooses the order of joining. The elements must hang together through their faces.
  NestedLU(int unknowns, const std::vector<CoupledUnknowns>&);

  /// An element's unknowns in the order of its matrix.
  const std::vector<int>& order(int element) const { return fronts_[element].unknowns; }
  /// All elements, one subdomain after the other.
  const std::vector<int>& elements() const { return elements_; }
  /// Condenses an element's matrix, and joins all subdomains whose parts are there. Each element has to be given once;
  /// in the order of `elements` few condensed matrices wait for others. False once `stop` is set, which is looked at
  /// between the parts of the work: then `drop_factors` has to come before a new beginning.
  bool condense(int element, const Matrix& matrix, const std::atomic<bool>* stop = nullptr);
  /// Once all elements are condensed: whether the sum of their matrices is finite and regular.
  bool is_regular() const;
  /// To the digits of `Scalar`.
  Eigen::VectorXd solve(const Eigen::VectorXd& rhs) const;
  /// Several right-hand sides at once, which takes far less than one after the other: the factors come from memory.
  Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& rhs) const;

  /// Frees the memory of the factors; the order stays.
  void drop_factors();

  double flops() const { return flops_; }  ///< of one factorisation, elements included
  double entries() const;                  ///< of the factors
  std::size_t memory_bytes() const { return std::size_t(entries()) * sizeof(Scalar); }

 private:
  /// Unknowns of a part, one after the other, that follow each other in the whole as well: those of a face, say.
  struct Run {
    int in_part, in_whole, size;
  };
  struct Front {
    std::vector<int> unknowns;  ///< those that are eliminated first
    int eliminated = 0;
    std::array<int, 2> parts{-1, -1};  ///< the fronts that are joined
    int whole = -1;                    ///< the front that this one is a part of; -1: none
    bool waits = false;                ///< condensed, for the other part
    /// Of the parts' remaining unknowns: those that are eliminated here, and the others, counted from 0 as well.
    std::array<std::vector<Run>, 2> ended, left;
    Eigen::PartialPivLU<Matrix> lu;
    Matrix solved_columns, rows;  ///< K_ff^-1 K_fo and K_of
    Matrix schur;                 ///< of the remaining unknowns, until it is joined
  };
  /// A matrix, split at the unknowns that are eliminated.
  struct Blocks {
    Matrix own, columns;  ///< K_ff, K_fo
    Matrix rows, rest;    ///< K_of, K_oo
  };
  static bool eliminate(Front&, Blocks, const std::atomic<bool>* stop);
  Blocks joined(const Front&);
  template <int columns>
  Eigen::Matrix<double, Eigen::Dynamic, columns> substituted(
      const Eigen::Matrix<double, Eigen::Dynamic, columns>& rhs) const;
  static void append(int in_part, int in_whole, std::vector<Run>& runs);

  std::vector<Front> fronts_;  ///< elements first, each after its parts, the whole last
  std::vector<int> elements_;
  double flops_ = 0;
};

}  // namespace rheocyte
