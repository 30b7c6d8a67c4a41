"""The tests of the pages read them as README.md says."""
import tempfile
import unittest
from pathlib import Path

from generated import compared, content
from page import Page, PageError
from run_page import asTested
from words import unknown


def page(text):
    with tempfile.NamedTemporaryFile("w", suffix=".md") as file:
        file.write(text)
        file.flush()
        return Page(file.name)


class Pages(unittest.TestCase):
    def test_commands_come_without_comments_and_in_whole_lines(self):
        block = page("```sh\n# a comment\nballbot run a.yaml \\\n    --seed 7   # why\n\nballbot doctor\n```\n").blocks[0]
        self.assertEqual(block.commands, ["ballbot run a.yaml --seed 7   # why", "ballbot doctor"])

    def test_a_mark_is_for_commands_that_begin_so(self):
        block = page('<!-- test add "ballbot run": --set duration_s=1 -->\n<!-- test skip "ballbot view": by hand -->\n'
                     "```sh\nballbot run a.yaml # why\nballbot view a\nballbot doctor\n```\n").blocks[0]
        self.assertEqual([asTested(block, c) for c in block.commands],
                         ["ballbot run a.yaml --set duration_s=1 # why", None, "ballbot doctor"])

    def test_a_command_in_a_block_that_no_test_runs_is_refused(self):
        for text in ("```\nballbot run a.yaml\n```\n", "    ballbot run a.yaml\n", "```\n./bootstrap run\n```\n"):
            with self.assertRaisesRegex(PageError, "Begin the block with ```sh"):
                page(text)

    def test_a_mark_without_its_block_reason_or_name_is_refused(self):
        for text in ("<!-- test skip: no -->\n```\nx\n```\n", "<!-- test skip: -->\n", "<!-- test slip: no -->\n",
                     "<!-- test skip: no -->\n"):
            with self.assertRaises(PageError):
                page(text)

    def test_a_generated_block_ends_where_its_mark_says(self):
        read = page("<!-- generated: echo 1 -->\n1\n<!-- end -->\n<!-- generated on request: slow -->\n<!-- end -->\n")
        self.assertEqual([(g.command, g.on_request, read.lines[g.first:g.last]) for g in read.generated],
                         [("echo 1", False, ["1"]), ("slow", True, [])])
        with self.assertRaisesRegex(PageError, "without <!-- end -->"):
            page("<!-- generated: echo 1 -->\n1\n")

    def test_a_stale_number_is_found_and_wall_clock_time_is_none(self):
        self.assertNotEqual(compared(["tilt 3 deg"]), compared(["tilt 4 deg"]))
        old, new = ["10.00 s in 4.57 s, 2.19 times real time"], ["10.00 s in 9.10 s, 1.10 times real time"]
        self.assertEqual(compared(old), compared(new))
        self.assertEqual(content(["```", *old, "```"], new + ["tilt 4 deg"]), ["```", *old, "tilt 4 deg", "```"])

    def test_a_verb_or_an_option_that_is_not_there_is_found(self):
        verbs = {"run": {"--seed"}}
        self.assertIsNone(unknown("ballbot run RUN --seed 7", verbs, {"--seed"}))
        self.assertIn("knows no --session", unknown("ballbot run RUN --session 7", verbs, {"--seed"}))
        self.assertIn("no verb 'walk'", unknown("ballbot walk", verbs, {"--seed"}))
        self.assertIn("--session", unknown("--session", verbs, {"--seed"}))


if __name__ == "__main__":
    unittest.main(verbosity=2)
