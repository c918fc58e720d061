# SPDX-License-Identifier: BSD-3-Clause
"""Data files of LAMMPS and LIGGGHTS, by plain splitting of lines."""


class Data:
    """The lines of the header and the rows of each section, as words."""

    def __init__(self, path):
        with open(path) as file:
            lines = [line.split("#")[0].split() for line in file.read().split("\n")[1:]]
        self.sections = {}
        rows = self.header = []
        for words in lines:
            if words and words[0][0].isalpha():
                rows = self.sections[" ".join(words)] = []
            elif words:
                rows.append(words)

    def rows(self, name):
        """Rows of numbers by their first number, in their order."""
        return {int(words[0]): [float(word) for word in words[1:]] for words in self.sections.get(name, [])}
