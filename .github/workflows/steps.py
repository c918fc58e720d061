#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""steps.py FILE JOB [name=value...] prints the shell steps of a job of a workflow as one script, without the actions of the host:

    tests/on trixie+ci bash -c "$(.github/workflows/steps.py .github/workflows/tests.yml debian matrix.command=tests/run)"

Values are those of expressions, such as matrix.suite and github.token. Needs python3-yaml."""
import re
import sys

import yaml

values = dict(word.split("=", 1) for word in sys.argv[3:])
with open(sys.argv[1], encoding="utf-8") as stream:
    steps = yaml.safe_load(stream)["jobs"][sys.argv[2]]["steps"]
print("set -e")
for step in steps:
    text = step.get("run", f"# left out: {step.get('uses')}")
    lines = [f"export {name}='{value}'" for name, value in step.get("env", {}).items()] + [text.strip()]
    script = re.sub(r"\$\{\{ *([\w.]+) *\}\}", lambda match: values[match.group(1)], "\n".join(lines))
    print(f"echo '-- {step.get('name', step.get('uses'))}'\n{script}")
