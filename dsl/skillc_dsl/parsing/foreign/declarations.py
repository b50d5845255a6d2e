"""Declarations and members as other languages write them."""

from __future__ import annotations

from skillc_dsl.parsing.foreign.form import inner, leading

_NAME = r"[\w:]+"
_TYPE = r"(?:\w+:)?[A-Z]\w*"

_PLAIN = (
    ("float\\d*|double|real", "Number"),
    ("string|str|char", "Text"),
    ("bool|boolean", "Bool"),
    ("u?int\\d*(?:_t)?", "Int"),
)
"""Types of other languages, and how they are called here."""

FORMS = (
    leading(
        r"<[?!/]?\w.*", None, "trees are not written in XML, but as steps: `do seq { .. }`; `skillc compile` writes XML"
    ),
    leading(r"\(define\b.*", None, "a domain is written as `skill NAME { .. }`; `skillc compile` writes PDDL"),
    leading(r"\(:(?:durative-)?action\b.*", None, "write `skill NAME { .. }`"),
    leading(r"\(?:(?:parameters|vars)\b.*", None, "each parameter is a line, such as `in arm: ArmDevice`"),
    leading(r"\(?:(?:precondition|condition)\b.*", None, "each precondition is a line, such as `pre a RELATION b`"),
    leading(r"\(?:effect\b.*", None, "each effect is a line, such as `post a RELATION b` or `post not a RELATION b`"),
    leading(r"\(?:duration\b.*", None, "write `duration 8 s`"),
    leading(
        r"\(?:(?:goal|init|objects|requirements|types|predicates)\b.*",
        None,
        "PDDL is not read here; a goal is `goal C`",
    ),
    leading(
        r"class\s+(?P<a>\w+)\s*(?:\(|:|\bextends\b)\s*(?:public\s+)?[\w.:]*(?:Skill|Action|Node|Primitive|Behaviou?r)\w*.*",
        None,
        r"write `skill \g<a> { .. }`",
    ),
    leading(rf"(?:skill|class)\s+(?P<a>\w+)\s+implements\s+(?P<b>{_NAME})", r"impl \g<a> of \g<b>"),
    leading(
        rf"impl\s+(?P<a>\w+)\s*(?:\bfor\b|\bimplements\b|\bextends\b|:(?!:))\s*(?P<b>{_NAME})", r"impl \g<a> of \g<b>"
    ),
    leading(rf"impl\s+(?P<a>\w+)\s*\(\s*(?P<b>{_NAME})\s*\)", r"impl \g<a> of \g<b>"),
    leading(r"impl\s+(?P<a>\w+)(?:\.|::)(?P<b>\w+)", r"impl \g<b> of \g<a>"),
    leading(rf"impl\s+(?P<a>{_NAME})\[(?P<b>\w+)\]", r"impl \g<b> of \g<a>"),
    leading(rf"impl\s+(?P<a>\w+)\s+of\s+skill\s+(?P<b>{_NAME})", r"impl \g<a> of \g<b>"),
    leading(rf"impl\s+(?P<a>\w+)\s+of\s+(?P<b>{_NAME})\s*\(\s*\)", r"impl \g<a> of \g<b>"),
    leading(r'impl\s+"(?P<a>\w+)"\s+of\b', r"impl \g<a> of"),
    leading(r"impl\s+(?P<a>\w+)-(?P<b>\w+)\s+of\b", r"impl \g<a>_\g<b> of"),
    leading(rf"impl\s+(?:for\s+)?(?P<a>{_NAME})\s*\{{", None, r"write `impl NAME of \g<a> {`"),
    leading(r"(?:implementation|implement|method)\b(?=\s+\w+\s+of\b)", "impl", where="CLASS"),
    leading(r"(?:implementation|implement|method)\b.*", None, "write `impl NAME of SKILL { .. }`", "CLASS"),
    leading(r"skill\s+(?P<a>\w+)\s*\(\s*\)", r"skill \g<a>"),
    leading(r"skill\s+\w+\s*\(.*", None, "each parameter is a line in the braces, such as `in arm: ArmDevice`"),
    leading(r"skill\s+\w+\s*(?:extends\b|<|:\s*\w).*", None, "a skill has no parents: it calls other skills"),
    leading(r"(?:def|action|procedure|behaviou?r)\s+(?=\w+\s*\{)", "skill ", where="CLASS"),
    leading(r"(?:def|action|procedure|behaviou?r)\b.*", None, "write `skill NAME { .. }`", "CLASS"),
    leading(r"(?:public|private|abstract|static|export)\s+(?=\w)", "", where="CLASS"),
    leading(r"(?:struct|interface)\b.*", None, "write `class NAME < PARENT`", "CLASS"),
    leading(r"(?:namespace|module|package)\b.*", None, "delete it: the files of a folder are a library", "CLASS"),
    leading(
        rf"class\s+(?P<a>\w+)\s*(?:(?::|\bextends\b|\bis\b|\bsubClassOf\b)\s*(?P<b>{_NAME})|\((?P<c>{_NAME})\))",
        r"class \g<a> < \g<b>\g<c>",
    ),
    leading(rf"class\s+(?P<a>\w+\s*<\s*{_NAME})\s*\{{\s*\}}", r"class \g<a>"),
    leading(rf"relation\s+(?P<a>\w+)\s*:\s*(?P<b>{_NAME})\s*->\s*(?P<c>{_NAME})", r"relation \g<a>(\g<b>, \g<c>)"),
    leading(
        rf"relation\s+(?P<a>\w+)\s*\(\s*\w+:\s*(?P<b>{_NAME})\s*,\s*\w+:\s*(?P<c>{_NAME})\s*\)",
        r"relation \g<a>(\g<b>, \g<c>)",
    ),
    leading(rf"relation\s+(?P<a>\w+)\s+(?P<b>{_NAME}),?\s+(?P<c>{_NAME})", r"relation \g<a>(\g<b>, \g<c>)"),
    leading(rf"property\s+(?P<a>\w+)\s*\((?P<b>{_NAME})\)\s*(?:->|=)", r"property \g<a>(\g<b>):"),
    leading(r"property\s+(?P<a>\w+)\.(?P<b>\w+)\s*:", r"property \g<b>(\g<a>):"),
    leading(rf"function\s+(?P<a>\w+\(.*\))\s*:\s*(?P<b>{_NAME})", r"function \g<a> -> \g<b>"),
    leading(
        r"import\s+<?(?P<a>[\w/]+)(?:\.skill)?>?\s*$",
        r'import "\g<a>.skill"',
        r'write `import "\g<a>.skill"` for a file, or `use \g<a>` for a vocabulary',
    ),
    leading(r"from\s+(?P<a>\w+)\s+import\b.*", r'import "\g<a>.skill"'),
    leading(r"include(?=\s*\")", "import"),
    leading(r"prefix\s+(?P<a>\w+)\s*=\s*(?P<b><\S*>)", r"prefix \g<a>: \g<b>"),
    # members
    *(leading(rf"(?P<a>in|opt|out|infer)\s+(?:{each})\s+(?P<b>\w+)", rf"\g<a> \g<b>: {kind}") for each, kind in _PLAIN),
    *(leading(rf"(?:{each})\s+(?P<b>\w+)(?=\s*$)", rf"in \g<b>: {kind}", where="IN") for each, kind in _PLAIN),
    leading(rf"(?P<a>in|opt|out|infer)\s+\?(?P<b>\w+)\s+-\s+(?P<c>{_NAME})", r"\g<a> \g<b>: \g<c>"),
    leading(r"(?P<a>pre|post)\s+at\s+(?:start|end)\b", r"\g<a>"),
    leading(r"(?:pre|condition)\s+over\s+all\b", "hold"),
    leading(r"duration\s*\(\s*=\s*\?duration\s+(?P<a>\d[\d.]*)\s*\)", r"duration \g<a> s"),
    leading(r"goals\b:?", "goal", where="GOAL"),
    leading(r"steps?\s*\{", "do seq {", where="DO"),
    leading(
        r"(?:robot|robots|world|cell)\b.*", None, 'robots and things are in the scene: `scene "FILE.ttl"`', "SCENE"
    ),
    leading(r"scene\s+(?P<a>[\w./-]+\.ttl)\b", r'scene "\g<a>"'),
    leading(
        r"(?:const|constexpr|static|final)\s+(?:\w+\s+)?(?P<a>\w+)\s*=\s*(?P<b>.*\S)",
        None,
        r"write `let \g<a> = \g<b>` in an implementation, or `opt \g<a>: TYPE = \g<b>` in a skill",
        "PRE",
    ),
    leading(r"(?P<a>pre|hold|post|goal|duration|scene|prefer|in|opt|out|infer|uses|shares)\s*:(?=\s)", r"\g<a>"),
    leading(r"(?:requires?|precondition|given|assume)\b:?", "pre", where="PRE"),
    leading(r"(?:effects?|ensures?|postcondition)\b:?", "post", where="POST"),
    leading(r"invariant\b:?", "hold", where="HOLD"),
    leading(r"(?:input|param|parameter|arg)\b", "in", where="IN"),
    leading(r"output\b", "out", where="OUT"),
    leading(r"optional\b", "opt", where="OPT"),
    leading(r"priority\b", "prefer", where="PREFER"),
    leading(r"description\b.*", None, "a description stands in lines with `##` above the skill", where="PRE"),
    leading(rf"(?P<a>in|opt|out|infer)\s+(?P<b>\w+)\s+(?:as|=)\s+(?P<c>{_NAME})", r"\g<a> \g<b>: \g<c>"),
    leading(rf"(?P<a>in|opt|out|infer)\s+(?P<b>{_TYPE})\s+(?P<c>\w+)\s*$", r"\g<a> \g<c>: \g<b>"),
    leading(rf"(?P<b>{_TYPE})\s+(?P<c>\w+)\s*$", r"in \g<c>: \g<b>", where="IN"),
    leading(
        r"(?P<a>in|opt|out|infer)\s+(?P<b>\w+)\s*,\s*(?P<c>\w+)\s*:\s*(?P<d>.*\S)",
        r"\g<a> \g<b>: \g<d>\n    \g<a> \g<c>: \g<d>",
    ),
    inner(r"\bdefault\b", "=", where="EQUAL"),
    leading(r"(?P<a>(?:opt|in|refine)\b.*?)\s+in\s+(?P<b>\S.*?\.\.)", r"\g<a> range \g<b>", where="LABEL"),
    leading(r'(?P<a>(?:in|opt|out|infer)\s+\w+:)\s*"(?P<b>[\w:]+)"', r"\g<a> \g<b>"),
    leading(
        r"(?P<c>(?:opt|in|refine)\b.*)\[(?P<a>[^,\]]+),\s*(?P<b>[^,\]]+)\]", r"\g<c>range \g<a> .. \g<b>", where="RANGE"
    ),
    inner(rf"\b(?:[Ll]ist|[Aa]rray)\[(?P<a>{_NAME})\]", r"[\g<a>]"),
    inner(rf"\b(?P<a>{_NAME})\[\]", r"[\g<a>]"),
    leading(r"let\s+(?P<a>\w+)\s*:\s*[\w:]+\s*=(?!=)", r"let \g<a> ="),
    leading(r"(?:var|const|val|auto|def|set)\s+(?P<a>\w+)\s*:?=", r"let \g<a> =", where="LET"),
    leading(r"(?P<a>\w+)\s*=", r"let \g<a> =", where="LET"),
    inner(r":=", "=", where="EQUAL"),
    leading(
        rf"goal\s+(?P<a>{_NAME})\((?P<b>\w+:\s.*)", r"do \g<a>(\g<b>", r"a skill is not a condition: write `do \g<a>(`"
    ),
    leading(rf"(?:(?:run|call|execute|start)\s+)?(?={_NAME}\s*\()", "do ", where="DO"),
)
