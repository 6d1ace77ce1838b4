"""Each rule of check_floors on small trees: what breaks it is named with its line, what keeps it passes."""
import importlib.machinery
import importlib.util
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
LOADER = importlib.machinery.SourceFileLoader("check_floors", str(Path(__file__).with_name("check_floors")))
check_floors = importlib.util.module_from_spec(importlib.util.spec_from_loader(LOADER.name, LOADER))
LOADER.exec_module(check_floors)

HEADER = "#pragma once\n"


def body(lines):
    return "\n".join(["  x += 1;"] * lines)


class TreeTest(unittest.TestCase):
    def violations(self, tree):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in tree.items():
                path = Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            return [(str(name), line, sentence) for name, line, sentence in check_floors.violations(Path(folder))]

    def accept(self, tree):
        self.assertEqual(self.violations(tree), [])

    def reject(self, tree, place, words):
        found = self.violations(tree)
        self.assertEqual([(name, line) for name, line, _ in found], [place], found)
        self.assertIn(words, found[0][2])


class Floors(TreeTest):
    def test_includes_down_and_on_the_same_floor_pass(self):
        self.accept({"src/solve/a.cc": '#include "fem/b.h"\n#include "case/c.h"\n#include "solve/a.h"\n'})

    def test_an_include_of_a_higher_floor_fails(self):
        self.reject({"src/case/a.cc": '\n#include "fem/b.h"\n'}, ("src/case/a.cc", 2), "fem is a higher floor")

    def test_a_commented_include_passes(self):
        self.accept({"src/case/a.cc": '// #include "fem/b.h"\n/*\n#include "fem/b.h"\n*/\n'})

    def test_sideways_passes_in_one_direction(self):
        self.accept({"src/fem/a.cc": '#include "shape/b.h"\n'})

    def test_sideways_fails_in_both_directions(self):
        tree = {"src/fem/a.cc": '#include "shape/b.h"\n', "src/shape/b.cc": '#include "fem/a.h"\n'}
        self.assertEqual([place[:2] for place in self.violations(tree)], [("src/fem/a.cc", 1), ("src/shape/b.cc", 1)])

    def test_an_include_without_floor_fails(self):
        self.reject({"src/fem/a.cc": '#include "mesh.h"\n'}, ("src/fem/a.cc", 1), "does not start with a floor")

    def test_a_folder_that_is_no_floor_fails(self):
        self.reject({"src/misc/a.cc": "\n"}, ("src/misc/a.cc", 1), "floors are")

    def test_reserved_libraries_fail_elsewhere(self):
        for library, owner, other in (("toml++/toml.h", "case", "laws"),
                                      ("CLI/CLI.hpp", "app", "case"), ("hdf5.h", "measurement", "infer")):
            self.accept({f"src/{owner}/a.cc": f"#include <{library}>\n"})
            self.reject({f"src/{other}/a.cc": f"#include <{library}>\n"}, (f"src/{other}/a.cc", 1), f"only src/{owner}")
            self.accept({"tests/fem/a.cc": f"#include <{library}>\n"})

    def test_a_library_may_have_two_owners(self):
        self.accept({f"src/{owner}/a.cc": "#include <hdf5.h>\n" for owner in ("measurement", "table")})


class Formats(TreeTest):
    def test_rooms_that_return_values_make_no_tables_and_no_json(self):
        for line, words in (('append("\\t");', "a tab"), ('"a\\tb"', "a tab"), ('"\\t\\n"', "a tab"),
                            ("#include <nlohmann/json.hpp>", "nlohmann"),
                            (r'text += "{\"value\": 1}";', "JSON"), (r'format(", \"error\": {}", e)', "JSON")):
            for room in ("events", "shelf", "extract", "experiment"):
                self.reject({f"src/{room}/a.cc": f"\n{line}\n"}, (f"src/{room}/a.cc", 2), words)
            self.accept({"src/report/a.cc": f"{line}\n"})

    def test_blanks_that_are_stripped_and_words_in_quotes_pass(self):
        self.accept({"src/events/a.cc": r'''strip(text, " \t\r\n"); strip(text, "[] \t"); say("the medium \"{}\" has");
f("such as [\"A1.rtdc\", \"A2.rtdc\"]."); // a\tb
'''})

    def test_a_column_has_one_spelling(self):
        for name in ("young_modulus_error_kPa", "standard_error_kPa", "standard_error_asymmetry_kPa", "value_upper_kPa",
                     "lower_Pa", "axial_tension_error_Pa"):
            for file, text in (("src/report/a.cc", f'"{name}"'), ("python/rheocyte/a.py", f"frame['{name}']"),
                               ("page/src/a.ts", f"said('{name}')")):
                self.reject({file: f"\n{text}\n"}, (file, 2), "no name of a column")
        self.accept({"src/report/a.cc": '"young_modulus_kPa_error", s.young_error_kPa, "error_percent"\n',
                     "src/report/former_names.cc": '"standard_error_kPa"\n',
                     "tests/report/a.cc": '"standard_error_kPa"\n'})


class Headers(TreeTest):
    def test_a_header_needs_pragma_once(self):
        self.accept({"src/case/a.h": "// comment\n" + HEADER})
        self.reject({"src/case/a.h": "// #pragma once\n"}, ("src/case/a.h", 1), "#pragma once")

    def test_using_namespace_fails_in_headers_only(self):
        self.reject({"src/case/a.h": HEADER + "\nusing namespace std;\n"}, ("src/case/a.h", 3), "using namespace")
        self.accept({"src/case/a.cc": "using namespace std;\n", "src/case/a.h": HEADER + "// using namespace std;\n"})


class Lengths(TreeTest):
    def test_files_end_at_the_limit(self):
        for name, greatest in (("src/case/a.cc", 300), ("tests/case/a.cc", 400), ("python/a.py", 400)):
            self.accept({name: "\n" * greatest})
            self.reject({name: "\n" * (greatest + 1)}, (name, greatest + 1), f"{greatest + 1} lines")

    def test_functions_end_at_the_limit(self):
        self.accept({"src/case/a.cc": f"int f() {{\n{body(58)}\n}}\n"})
        self.reject({"src/case/a.cc": f"\nint f() {{\n{body(59)}\n}}\n"}, ("src/case/a.cc", 2), "61 lines")

    def test_each_kind_of_function_is_measured(self):
        heads = ("template <class T = int>\nbool operator==(const T& a, const T& b) {", "TEST(Mesh, IsClosed) {",
                 "auto f(int a = 3) -> int {", "const auto f = [](int x) {", "struct S { int f() const {",
                 "namespace a { namespace { void f() noexcept {", "S::S(int x) : a_(x), b_(x) {",
                 "template <class T>\nvoid Grid<T>::f(const std::vector<T>& x) {")
        for head in heads:
            closing = "}" * head.count("{")
            found = self.violations({"src/case/a.cc": f"{head}\n{body(100)}\n{closing};\n"})
            self.assertEqual([sentence[:16] for _, _, sentence in found], ["the function has"], head)

    def test_tables_and_types_are_not_functions(self):
        rows = "\n".join(["  {1, 2},"] * 100)
        members = "\n".join(["  int f() const { return 1; }  // }"] * 100)
        self.accept({"src/case/a.cc": f"constexpr Row rows[] = {{\n{rows}\n}};\n"})
        self.accept({"src/case/a.h": f"{HEADER}template <class T>\nstruct alignas(16) S : B<T> {{\n{members}\n}};\n"})

    def test_braces_in_text_do_not_count(self):
        text = 'void f() { g("{", \'{\', R"({)", 1\'000); /* { */ }\n' * 60
        self.accept({"src/case/a.cc": text + f"#define OPEN {{ \\\n  {{\nvoid h() {{\n{body(50)}\n}}\n"})

    def test_python_functions_are_measured(self):
        text = "def f(x):\n" + "    x += 1\n" * 80
        self.reject({"python/a.py": text}, ("python/a.py", 1), "81 lines")
        self.reject({"tools/a": "#!/usr/bin/env python3\n" + text}, ("tools/a", 2), "81 lines")


class Circles(TreeTest):
    def test_modules_that_import_downwards_pass(self):
        self.accept({"python/p/a.py": "from p import b\n", "python/p/b.py": "import numpy\n"})
        self.accept({"page/src/a.ts": "import { b } from './c/b';\n", "page/src/c/b.tsx": "import 'preact';\n"})

    def test_python_modules_in_a_circle_fail_where_they_import_late(self):
        tree = {"python/p/a.py": "from p import b\n", "python/p/b.py": "def f():\n    from p.a import g\n"}
        self.reject(tree, ("python/p/a.py", 1), "python/p/a.py -> python/p/b.py -> python/p/a.py")

    def test_modules_of_the_page_in_a_circle_fail_where_they_import_types(self):
        tree = {"page/src/a.tsx": "import { B } from './b';\n", "page/src/b.ts": "import type { A } from './a';\n"}
        self.reject(tree, ("page/src/a.tsx", 1), "in a circle")


class Names(TreeTest):
    def test_vague_names_fail(self):
        for name in ("python/utils.py", "src/fem/mesh_utils.cc", "tests/utils/a.txt"):
            self.reject({name: "\n"}, (name, 1), "says nothing")
        self.accept({"docs/utilisation.md": "\n"})

    def test_paths_of_one_machine_fail(self):
        for folder in ("work/x", "root/x", "home/ada/x", "tmp/build"):
            self.reject({"docs/a.md": f"\nsee `/{folder}`\n"}, ("docs/a.md", 2), "one machine")
        for harmless in ("https://example.org/{}/a", "${{HOME}}/{}/", "./{}/", "/tmp/other"):
            self.accept({"docs/a.md": harmless.format("work") + "\n"})

    def test_binary_files_pass(self):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "picture.png").write_bytes(b"\x89PNG\xff\xfe")
            self.assertEqual(check_floors.violations(Path(folder)), [])


class Labels(TreeTest):
    EQUATIONS = "`eq:a`\n```math\nx\n```\n5. `eq:b`  $y$\n"

    def test_labels_of_equations_pass(self):
        self.accept({"docs/a.md": self.EQUATIONS + "by `eq:a` and eq:b\n", "src/fem/a.cc": "// docs/a.md, eq:b\n"})

    def test_a_label_without_an_equation_fails(self):
        self.reject({"docs/a.md": self.EQUATIONS, "src/fem/a.cc": "\n// eq:c\n"}, ("src/fem/a.cc", 2), "eq:c")

    def test_a_label_in_another_document_fails(self):
        tree = {"docs/a.md": self.EQUATIONS, "docs/b.md": "\n", "src/fem/a.cc": "// docs/b.md, eq:a\n"}
        self.reject(tree, ("src/fem/a.cc", 1), "stands in docs/a.md")

    def test_a_label_at_two_equations_fails(self):
        self.reject({"docs/a.md": self.EQUATIONS, "docs/b.md": "`eq:b`\n"}, ("docs/b.md", 1), "another equation")

    def test_documents_and_links_that_are_there_pass(self):
        tree = {"docs/a.md": "[b](b.md), [c](../c.txt), [d](b.md#d), [e](https://example.org/e.md)\n", "c.txt": "\n"}
        self.accept({**tree, "docs/b.md": "docs/a.md\n"})

    def test_documents_and_links_that_are_not_there_fail(self):
        self.reject({"docs/a.md": "[b](b.md)\n"}, ("docs/a.md", 1), "there is no docs/b.md")
        self.reject({"src/fem/a.cc": "// docs/b.md\n"}, ("src/fem/a.cc", 1), "there is no docs/b.md")


class Words(TreeTest):
    def test_words_of_no_sentence_fail_in_strings(self):
        self.reject({"src/fem/a.cc": '\nf("the data tell"\n  " nothing");\n'}, ("src/fem/a.cc", 2), '"tell"')
        self.reject({"src/fem/a.cc": 'f(R"(a\nmade anew)");\n'}, ("src/fem/a.cc", 2), '"anew"')
        self.reject({"python/rheocyte/a.py": '"""A.\n\nWhoever\n"""\n'}, ("python/rheocyte/a.py", 3), '"Whoever"')
        self.reject({"page/src/a.tsx": "const a = (\n  <p>It is told.</p>\n);\n"}, ("page/src/a.tsx", 2), '"told"')

    def test_words_of_no_sentence_fail_in_documents(self):
        self.reject({"docs/figures/a.md": "A `tell`.\nNobody.\n"}, ("docs/figures/a.md", 2), '"Nobody"')
        self.reject({"CHANGELOG.md": "Told.\n"}, ("CHANGELOG.md", 1), '"Told"')

    def test_identifiers_comments_and_codes_pass(self):
        self.accept({"src/fem/a.cc": '// likewise\ntell("not-told-apart");\n', "page/src/a.ts": "tell('it'); // nobody\n"})
        self.accept({"python/rheocyte/a.py": "tell = 1  # told\n", "python/tests/a.py": '"""Told."""\n'})


if __name__ == "__main__":
    unittest.main()
