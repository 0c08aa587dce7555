# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
"""Members that mean the same wherever they stand: said once, here, and shown wherever nothing else is said."""
import re

LAW = "contact/laws/"

# Of descriptions, which Model::add takes.
OF_DESCRIPTIONS = {
    "name": "Unique in the model: columns and messages use it.",
    "body": "The body it acts on.",
    "a": "The first body; the ground is `ground`.",
    "b": "The second body; the ground is `ground`.",
    "law": "The contact law: elastic, dissipative, friction.",
}

# (kind, name, where, text); the first that fits. `where` is the beginning of the header's path.
SAID = [
    ("function", "build", "", "Makes the element, placed by the start pose of the model; Model::add calls it. Throws ModelError."),
    ("function", "elements", "", "Makes the elements, placed by the start pose of the model; Model::add calls it. Throws ModelError."),
    ("variable", "fields", LAW, "Its numbers by name and unit: for the catalogue, and to be changed during a run."),
    ("function", "with_fields", LAW, "The law with these numbers in place of its `fields`."),
    ("function", "operator()", LAW + "elastic/", "Force, stiffness and energy at a penetration [m] >= 0."),
    ("function", "operator()", LAW + "dissipative/", "Force, derivatives, stored energy and dissipated power in a contact."),
    ("function", "operator()", LAW + "friction/", "Friction along the wall and its derivatives; > 0 against a sliding velocity > 0."),
    ("function", "operator()", LAW + "local_law", "Force, stiffness and energy at a penetration [m] >= 0."),
    ("function", "name", LAW, "For results and errors, as in `yoke law list`."),
    ("function", "check", LAW, "Throws ModelError for a parameter out of range; called when the law is made a value."),
    ("function", "limit", LAW, "[m] Largest penetration the law holds for."),
    ("function", "release", LAW, "Where a contact under the law ends."),
    ("variable", "tensile", LAW, "What becomes of the phase in which the law pulls."),
    ("variable", "slowest_approach", LAW, "[m/s] > 0, floor of the approach velocity."),
    ("function", "permanent_set", LAW, "[m] Indentation that stays, known at the end of compression."),
    ("function", "kink", LAW, "[m] Changes sign at the corner of the formula."),
    ("function", "force_change", LAW, "[N m] Derivative of the force while the elastic law changes by `change`."),
    ("function", "needs_largest_penetration", LAW, "Whether the end of compression is to be located."),
    ("function", "state_scale", LAW + "friction/", "Usual size of the state z under a normal force [N]; its error weight is made of it."),
    ("function", "holding_force", LAW + "friction/", "[N] What the surfaces can hold at rest under a normal force [N]."),
]

COPIES = "Copies and moves as a value."


def text_of(symbol, outer):
    if symbol.name == "operator=":
        return COPIES
    if outer and any(m.name in ("build", "elements") for m in outer.members) and symbol.name in OF_DESCRIPTIONS:
        return OF_DESCRIPTIONS[symbol.name]
    if outer and symbol.name == outer.name.split("::")[-1]:
        own = re.escape(symbol.name)
        if re.search(rf"\((const )?{own} ?(<[^>]*>)? ?&+( ?\w+)?\)", symbol.signature):
            return COPIES
    for kind, name, where, text in SAID:
        if (kind, name) == (symbol.kind, symbol.name) and symbol.file.startswith(where):
            return text
    return ""


def inherited(symbol, bases, classes):
    """What a base class says of the function that this one overrides."""
    for base in bases:
        base_class = classes.get(re.sub(r"<.*", "", base).replace("yoke::", "").strip())
        if base_class is None:
            continue
        for m in base_class.members:
            if m.kind == "function" and m.name == symbol.name and m.text:
                return m.text
        text = inherited(symbol, base_class.bases, classes)
        if text:
            return text
    return ""
