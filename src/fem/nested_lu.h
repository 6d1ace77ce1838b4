// Direct solution of a finite-element system by condensing ever larger subdomains: elements are joined in pairs,
// pairs in pairs, and each time all unknowns that no other element knows are eliminated from a dense matrix
// (docs/theory-square.md, eq:nested). With 50 to 150 elements of high degree the faces between subdomains are large
// dense blocks by themselves, so that no ordering of single unknowns could do better, and no library is needed.
//
// Matrices and factors may have single precision, which halves memory and time: they only correct a state, and Newton's
// method, whose residuals have double precision, goes on with the same factors until nothing is left to correct.
#pragma once
#include <Eigen/Core>
#include <array>
#include <atomic>
#include <mutex>
#include <optional>
#include <vector>

#include "fem/triangular_solve.h"
#include "store/tasks.h"

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

  /// Ranks of tasks: a subdomain that is begun is ended first, then others are joined, and elements come last, so that
  /// few condensed matrices wait.
  static constexpr int rank_of_blocks = 0, rank_of_joins = 1, rank_of_elements = 2;
  /// Of the remaining columns of a subdomain those that are condensed in one task, however many threads there are.
  static Eigen::Index columns_at_once(Eigen::Index remaining);

  /// Chooses the order of joining. The elements must hang together through their faces.
  NestedLU(int unknowns, const std::vector<CoupledUnknowns>&);

  /// An element's unknowns in the order of its matrix.
  const std::vector<int>& order(int element) const { return fronts_[element].unknowns; }
  /// All elements, one subdomain after the other.
  const std::vector<int>& elements() const { return elements_; }
  /// Condenses an element's matrix; once both parts of a subdomain are there, their joining is added to the tasks,
  /// which may be shared by several threads: the sums have the same order regardless of thread and time. Each element
  /// has to be given once; in the order of `elements` few condensed matrices wait for others. Once `stop` is set, which
  /// is looked at between the parts of the work, no more is done: then, and after an exception, `drop_factors` has to
  /// come before a new beginning.
  void condense(int element, const Matrix& matrix, Tasks&, const std::atomic<bool>* stop = nullptr);
  /// The same at once, with all that can be joined. False once `stop` is set.
  bool condense(int element, const Matrix& matrix, const std::atomic<bool>* stop = nullptr);
  /// Once all elements are condensed: whether the sum of their matrices is finite and regular.
  bool is_regular() const;
  /// To the digits of `Scalar`.
  Eigen::VectorXd solve(const Eigen::VectorXd& rhs) const;
  /// Several right-hand sides at once, which takes far less than one after the other: the factors come from memory.
  Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& rhs) const;

  /// Frees the memory of the factors; the order stays.
  void drop_factors();

  /// How many unknowns of a subdomain are eliminated and remain, and what is joined to it (-1: it is an element).
  struct Size {
    std::array<int, 2> parts;
    int eliminated, remaining;
  };
  /// Elements first, each subdomain after its parts.
  std::vector<Size> sizes() const;
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
    /// Column by column of the matrix here, that of the part's remaining unknowns; -1: none.
    std::array<std::vector<int>, 2> column_of_part;
    Matrix factors;                                       ///< L and U of K_ff, its rows permuted
    Eigen::VectorXi permuted_row;                         ///< where a row of K_ff is among those of the factors
    std::optional<TriangularFactors<Scalar>> triangular;  ///< of these, until the rest is condensed
    Matrix solved_columns, rows;                          ///< K_ff^-1 K_fo and K_of
    Matrix schur;                                         ///< of the remaining unknowns, until it is joined
    Eigen::Index remaining() const { return Eigen::Index(unknowns.size()) - eliminated; }
  };
  /// What is done with the tasks and when it ends.
  struct Work {
    Tasks& tasks;
    const std::atomic<bool>* stop;
    bool is_stopped() const { return stop && *stop; }
  };
  template <class Column>
  static void factorise(Front&, const Column&);
  template <class Column>
  static void condense_block(Front&, const Column&, Eigen::Index block);
  static Eigen::Index blocks_of(const Front&);
  void join(int front, const Work&);
  void end(int front, const Work&);
  void add_column(const Front&, Eigen::Index j, Scalar* first, Scalar* rest) const;
  template <int columns>
  Eigen::Matrix<double, Eigen::Dynamic, columns> substituted(
      const Eigen::Matrix<double, Eigen::Dynamic, columns>& rhs) const;
  static void append(int in_part, int in_whole, std::vector<Run>& runs);

  std::mutex waiting_;         ///< for which fronts wait
  std::vector<Front> fronts_;  ///< elements first, each after its parts, the whole last
  std::vector<int> elements_;
  double flops_ = 0;
};

}  // namespace rheocyte
