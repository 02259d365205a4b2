"""Cases in all their forms, and what is said of wrong ones."""
import unittest

import cellcrush as cc
import numpy as np
from google.protobuf.descriptor import FieldDescriptor
from support import PRESET, SMALL, WithServer


ALWAYS_WRONG = (object(), b"x", 1j, [[1]], np.ones((2, 2)))
WRONG = {  # by type
    FieldDescriptor.TYPE_MESSAGE: (None, 3, "x", [1], cc.Case()), FieldDescriptor.TYPE_BOOL: (None, "yes", 2, {"x": 1}),
    FieldDescriptor.TYPE_STRING: (None, True, 2.5, {"x": 1}, "\ud800"),
    FieldDescriptor.TYPE_ENUM: (None, "sideways", 2.5, 99, {"x": 1}),
    FieldDescriptor.TYPE_DOUBLE: (None, "fast", True, 10**400, {"x": 1}),
    FieldDescriptor.TYPE_INT32: (None, "many", True, 2.5, 2**31, {"x": 1}),
    FieldDescriptor.TYPE_SINT32: (None, "many", True, 2.5, 2**31, {"x": 1}),
    FieldDescriptor.TYPE_UINT64: (None, "many", True, 2.5, -1, 2**64, {"x": 1})}


def wrong_values(group=cc.Case.DESCRIPTOR, wrap=lambda value: value, prefix=""):
    """For every field of a case, in lists too: a case with a value that the field cannot take, and the path to it."""
    for field in group.fields:
        path, put = prefix + field.name, lambda value, name=field.name: wrap({name: value})
        if field.label == FieldDescriptor.LABEL_REPEATED:
            for wrong in (None, 3, "x", {"x": 1}, np.array(1)):
                yield put(wrong), path, wrong
            path, put = path + "[0]", lambda value, put=put: put([value])
        for wrong in (*WRONG[field.type], *ALWAYS_WRONG):
            yield put(wrong), path, wrong
        if field.message_type is not None:
            yield put({3: 1}), path + ".3", None
            yield from wrong_values(field.message_type, put, path + ".")


class Cases(WithServer):
    def test_every_field_refuses_a_wrong_type_by_its_path(self):
        count = 0
        for case, path, wrong in wrong_values():
            with self.assertRaises(cc.CaseError, msg=(path, wrong)) as raised:
                self.server.case(case)
            problem = raised.exception.problems[0]
            value = "" if path.endswith(".3") else str(wrong)
            self.assertEqual((problem.field, problem.value[:60]), (path, value[:60]))
            self.assertTrue(problem.remedy, path)
            count += 1
        self.assertGreater(count, 1000)

    def test_all_forms_give_the_same_case(self):
        case = self.server.case(PRESET, SMALL)
        from google.protobuf import json_format, text_format

        text = text_format.MessageToString(case)
        file = self.folder / "case.txtpb"
        file.write_text(text)
        nested = json_format.MessageToDict(case, preserving_proto_field_name=True)
        for form in (case, text, json_format.MessageToJson(case), file, str(file), nested):
            self.assertEqual(self.server.case(form), case, type(form))

    def test_fields_have_the_paths_of_everywhere(self):
        case = self.server.case(PRESET, {"contact.friction": 0.2}, lattice__hexagon__rows=5, direction="y",
                                threads=2.0)
        self.assertEqual((case.contact.friction, case.lattice.hexagon.rows, case.loading.direction,
                          case.numerics.threads), (0.2, 5, 2, 2))
        frame = self.server.case({"lattice.frame.nodes": [{"id": "a", "x_mm": 1}, {"id": "b"}]},
                                 {"lattice.frame.nodes[1].x_mm": 3})
        self.assertEqual([node.x_mm for node in frame.lattice.frame.nodes], [1, 3])

    def test_every_wrong_field_names_itself_and_the_remedy(self):
        for fields, field, remedy in (
                ({"speed_m_per_s": "fast"}, "loading.speed_m_per_s", "Give a number"),
                ({"columns": 2.5}, "lattice.hexagon.columns", "Give a whole number from -2147483648 to 2147483647."),
                ({"lattice.frame.nodes": 3}, "lattice.frame", "Start from a case"), ({3: 1}, "3", "texts"),
                ({"speed": 3}, "speed", "Did you mean speed_m_per_s?"),
                ({"friction": 0.1}, "friction", "contact.friction, plates.friction"),
                ({"direction": "Z"}, "loading.direction", "one of X, Y"),
                ({"lattice.square.rows": 3}, "lattice.square", "Start from a case"),
                ({"lattice.hexagon": 3}, "lattice.hexagon", "dict"),
                ({"loading.speed_m_per_s.x": 3}, "loading.speed_m_per_s", ""),
                ({"lattice.hexagon.colums": 3}, "lattice.hexagon.colums", "Did you mean columns?")):
            with self.assertRaises(cc.CaseError, msg=fields) as raised:
                self.server.submit(PRESET, fields)
            problem = raised.exception.problems[0]
            self.assertEqual(problem.field, field)
            self.assertIn(remedy, problem.remedy)

    def test_wrong_values_of_a_sweep_are_named(self):
        for fields, field, value in (({"direction": ["X", "Y"]}, "loading.direction", "X"),
                                     ({"speed_m_per_s": [40, "50 m/s"]}, "loading.speed_m_per_s", "50 m/s"),
                                     ({"columns": [None]}, "lattice.hexagon.columns", "None"),
                                     ({"depth_mm": np.ones((2, 2))}, "depth_mm", r"\[1. 1.\]"),
                                     ({"depth_mm": [3], "speed_m_per_s": None}, "loading.speed_m_per_s", "None"),
                                     ({"seeds": "3"}, "seeds", "3"), ({"seeds": 2.5}, "seeds", "2.5"),
                                     ({"seeds": -1}, "seeds", "-1"), ({"seeds": 10**12}, "seeds", "1000000000000")):
            with self.assertRaisesRegex(cc.CaseError, rf"^{field} .*\(found {value}\) Give", msg=fields):
                self.server.sweep(PRESET, **fields)

    def test_wrong_options_are_named(self):
        for options in ({"time_limit_s": "1 h"}, {"priority": 1.5}, {"executor": 3.5}, {"fields": "speed_m_per_s=5"}):
            for call in (self.server.submit, self.server.sweep):
                with self.assertRaisesRegex(cc.CaseError, f"^{next(iter(options))} is .*Give", msg=options):
                    call(PRESET, **{"fields": {"speed_m_per_s": [100]} if call == self.server.sweep else {}, **options})
        job = self.server.submit(PRESET, SMALL, labels={"batch": 3}).cancel()
        self.assertEqual(job.labels, {"batch": "3"})

    def test_the_daemon_lists_all_problems(self):
        with self.assertRaises(cc.CaseError) as raised:
            self.server.submit({"lattice.hexagon.columns": 1, "end_strain": 2})
        fields = [problem.field for problem in raised.exception.problems]
        self.assertIn("lattice.hexagon.columns", fields)
        self.assertIn("depth_mm", fields)
        self.assertTrue(all(problem.remedy for problem in raised.exception.problems))
        self.assertEqual(fields, [problem.field for problem in self.server.check(
            {"lattice.hexagon.columns": 1, "end_strain": 2}).problems])

    def test_a_check_of_a_wrong_case_has_problems_and_no_numbers(self):
        check = self.server.check({"lattice.hexagon.columns": 1, "end_strain": 2})
        self.assertEqual((check.predicted_seconds, check.step_count, check.mass_g, check.theory.shock_mpa), (None,) * 4)
        self.assertRegex(repr(check), "problem: lattice.hexagon.columns")
        self.assertIn("depth_mm", check._repr_html_())

    def test_what_cannot_be_read_is_refused(self):
        for source in ("nothing.txtpb", "depth_mm: x", '{"depth": 4}'):
            with self.assertRaises(cc.CaseError, msg=source):
                self.server.submit(source)
        for source in (None, 7, [PRESET]):
            with self.assertRaisesRegex(cc.CaseError, "case cannot be read.*found .*Give a file, preset:NAME"):
                self.server.submit(source)
        with self.assertRaisesRegex(cc.NotFound, "hexagon-small"):
            self.server.submit("preset:hexagon-smal")

    def test_a_check_predicts_the_run(self):
        check = self.server.check(PRESET, SMALL)
        self.assertEqual(check.problems, [])
        self.assertGreater(check.step_count, 100)
        self.assertGreater(check.theory.shock_mpa, check.theory.gibson_ashby_mpa)
        self.assertIn(PRESET, self.server.presets())
        self.assertIn("E 207000 MPa", self.server.materials()["mild steel"])
        self.assertIn("default", self.server.explain("end_strain"))
        self.assertRegex(str(self.server.check(PRESET, SMALL, density_kg_per_m3=2.7).notes[0]), "density")


if __name__ == "__main__":
    unittest.main()
