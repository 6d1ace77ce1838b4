// Whole tables that are computed from Python.
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "python/bindings.h"
#include "python/interruptible.h"
#include "shelf/tube_table.h"
#include "store/build_info.h"
#include "sweep/sample_branch.h"
#include "sweep/table_work.h"
#include "table/finish_table.h"

namespace rheocyte {

namespace py = pybind11;

namespace {

// Works on the folder of a table; reports branches that are done and all. Sentences about what could not be made.
std::vector<std::string> compute_table(const std::string& text, const std::string& name,
                                       const std::vector<std::string>& settings, const std::filesystem::path& place,
                                       int jobs, const std::optional<std::function<void(double)>>& progress) {
  const TableSpec spec = parse_table_spec(text, name, settings);
  return interruptible([&](const std::atomic<bool>& stop) -> std::vector<std::string> {
    const TableFolder folder(place, spec);
    provide_tube_table(folder);
    folder.take_over();
    const auto tell = [&](int done) {
      if (!progress) return;
      const py::gil_scoped_acquire acquired;
      (*progress)(static_cast<double>(done) / folder.branches());
    };
    if (!work_on(TableWork(folder), jobs > 0 ? jobs : available_processors(), {tell, {}}, stop)) return {};
    return finish_table(folder, {}, version);
  });
}

// The same work for an executor of Python: pieces go out, records come back.
class TablePieces {
 public:
  TablePieces(const std::string& text, const std::string& name, const std::vector<std::string>& settings,
              const std::filesystem::path& place)
      : folder_(place, parse_table_spec(text, name, settings)), work_(folder_) {
    provide_tube_table(folder_);
    folder_.take_over();
  }

  double fraction_done() const { return static_cast<double>(folder_.done()) / folder_.branches(); }
  bool is_complete() const { return work_.missing().empty(); }

  // Pieces that are missing and that no one works on, each with the record of the branch from which it goes on. They
  // are ours from now on.
  std::vector<std::pair<int, py::bytes>> take() {
    std::vector<std::pair<int, py::bytes>> taken;
    for (const int piece : work_.missing()) {
      const BranchTask task = task_of_piece(piece);
      if (ours_.contains(piece)) continue;
      Claim claim = work_.claim(piece);
      if (!claim || work_.has(piece)) continue;
      ours_.emplace(piece, std::move(claim));
      taken.emplace_back(
          piece, task.regularised ? py::bytes(to_bytes(folder_.branch(task.place, false), hash())) : py::bytes());
    }
    return taken;
  }

  void keep(int piece, const std::string& record) {
    const BranchTask task = task_of_piece(piece);
    folder_.keep(task.place, branch_from_bytes(record, hash(), "the record of an executor"), task.regularised);
    ours_.erase(piece);
  }

  // What was taken and not kept is no one's again; a traceback may keep this object for long.
  void give_up() { ours_.clear(); }

  std::vector<std::string> finish() const { return finish_table(folder_, {}, version); }

 private:
  std::string hash() const { return spec_hash(folder_.spec()); }

  TableFolder folder_;
  TableWork work_;
  std::map<int, Claim> ours_;
};

// What an executor's process does with a piece: the record of its branch.
py::bytes table_piece(const std::string& text, const std::string& name, const std::vector<std::string>& settings,
                      int piece, const std::string& bare_record) {
  const TableSpec spec = parse_table_spec(text, name, settings);
  const BranchTask task = task_of_piece(piece);
  const std::string hash = spec_hash(spec);
  return interruptible([&](const std::atomic<bool>& stop) {
    const SweepPoint place = sweep_places(spec).at(std::size_t(task.place));
    const auto regularised = [&] {
      return sample_regularised_branch(spec, place, branch_from_bytes(bare_record, hash, "the bare branch"), &stop);
    };
    return to_bytes(task.regularised ? regularised() : sample_branch(spec, place, &stop), hash);
  });
}

}  // namespace

const Binding bind_table_computation([](py::module_& module) {
  module.def("compute_table", &compute_table);
  module.def("table_piece", &table_piece);
  py::class_<TablePieces>(module, "TablePieces")
      .def(py::init<const std::string&, const std::string&, const std::vector<std::string>&,
                    const std::filesystem::path&>())
      .def("fraction_done", &TablePieces::fraction_done)
      .def("is_complete", &TablePieces::is_complete)
      .def("take", &TablePieces::take)
      .def("keep", &TablePieces::keep)
      .def("give_up", &TablePieces::give_up)
      .def("finish", &TablePieces::finish);
});

}  // namespace rheocyte
