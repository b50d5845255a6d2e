"""Steps as other languages write them."""

from __future__ import annotations

from skillc_dsl.parsing.foreign.form import inner, leading

_CALL = r"[A-Z]\w*\s*\(.*\)"
_BLOCK = r"seq|sel|try|once|invert|par\s+\w+|(?:retry|repeat)\s+\d+|timeout\s+[\d.]+\s?\w+"
_KIND = r"(?:var|const|val|auto|int|float|double|bool|string|def|set)"
_VALUE = r"values are named before the steps: `let \g<a> = \g<b>` above `do`"
_LOOP = "write `repeat 3 { .. }`, or `while C max 10 { .. }`"

_COUNT = r"(?:\w+\s+)?\w+\s*=\s*0\s*;\s*\w+\s*<\s*(?P<a>\d+)\s*;\s*(?:\+\+\s*\w+|\w+\s*(?:\+\+|\+=\s*1))\s*"
_FOR = "write `repeat 3 { .. }`, `for x in LIST { .. }` or `while C max 10 { .. }`"
_SEQ_FAILS = "delete it: a `seq` fails as soon as one of its steps fails"
_SEL = "write `sel { seq { .. } seq { .. } }`: the second runs if the first fails"
_PAR = "write `par all`, `par any`, `par race` or `par lead`"

FORMS = (
    inner(r"(?<=:\s)\{(?P<a>\w+)\}", r"\g<a>"),
    leading(rf"for\s*\(\s*{_COUNT}\)", r"repeat \g<a>"),
    leading(r"for\s*\([^:)]*;.*", None, _FOR),
    leading(r"for\s*\(\s*(?:const\s+)?\w+\s*[&*]?\s*(?P<a>\w+)\s*:\s*(?P<b>[^)]*?)\s*\)", r"for \g<a> in \g<b>"),
    leading(
        r"for\s+\w+\s+in\s+range\(\s*(?:0\s*,\s*)?(?P<a>\d+)\s*\)\s*:?", r"repeat \g<a>", r"write `repeat \g<a> { .. }`"
    ),
    leading(r"if\b[^{]*\b[A-Z]\w*\(.*\breturn\b.*", None, _SEQ_FAILS),
    leading(r"if\b.*\breturn\b.*", None, "put the steps after it into `if not (C) { .. }`"),
    leading(r"do\s*\{", None, "write `while C max 10 { .. }`", "RBRACE"),
    leading(r"RetryUntilSuccessful\s*\(\s*\w+\s*[=:]\s*(?P<a>\d+)\s*\)", r"retry \g<a>"),
    leading(r"Repeat\s*\(\s*\w+\s*[=:]\s*(?P<a>\d+)\s*\)", r"repeat \g<a>"),
    leading(r"Timeout\s*\(\s*msec\s*[=:]\s*(?P<a>\d+)\s*\)", r"timeout \g<a> ms"),
    leading(r"[Pp]arallel(?:All)?\s*\(.*\)(?=\s*\{)", "par all", _PAR),
    leading(r"ForceSuccess\b(?=\s*\{)", "try"),
    leading(r"ReactiveSequence\b(?=\s*\{)", "reactive seq"),
    leading(r"ReactiveFallback\b(?=\s*\{)", "reactive sel"),
    leading(r"(?:self\.|this(?:->|\.))(?P<a>[A-Z]\w*)", r"\g<a>"),
    leading(r"(?:elif|elseif|elsif)\b", "else if"),
    leading(r"otherwise\b", "else"),
    leading(
        r"try\s*\{(?P<a>[^{}]*)\}\s*(?:catch|except|else)\b\s*(?:\([^)]*\))?\s*\{(?P<b>[^{}]*)\}",
        r"sel { seq {\g<a>} seq {\g<b>} }",
    ),
    leading(r"(?:catch|except|rescue)\b\s*(?:\([^)]*\))?", None, _SEL),
    leading(r"try\s*:", None, _SEL),
    leading(
        r"finally\b",
        None,
        "write it after a block: `seq { .. } finally { .. }`; what is undone is a scoped skill: `with CALL { .. }`",
    ),
    leading(r"(?P<a>retry|repeat)\s+(?:up\s+to|at\s+most)\s+(?P<b>\d+)(?:\s+times)?", r"\g<a> \g<b>"),
    leading(r"(?P<a>retry|repeat)\s+(?P<b>\d+)\s*(?:times|x)\b", r"\g<a> \g<b>"),
    leading(r"repeat\s*\{.*\}\s*until\b.*", None, "write `while not C max 10 { .. }`"),
    leading(r"(?P<a>retry|repeat)\s*\{", r"\g<a> 3 {", r"say how often, such as `\g<a> 3 {`"),
    leading(r"loop\s+(?P<a>\d+)(?:\s+times)?", r"repeat \g<a>"),
    leading(r"(?:loop|forever)\b", None, _LOOP),
    leading(r"until\s+(?P<a>.*?)\s*\{", r"while not (\g<a>) max 10 {"),
    leading(
        r"while\s+(?P<a>.*?)\s*\{", r"while \g<a> max 10 {", r"say how often at most: `while \g<a> max 10 {`", "MAX"
    ),
    leading(r"for\s*\(\s*(?P<a>\w+)\s+(?:in|of)\s+(?P<b>.*?)\)", r"for \g<a> in \g<b>"),
    leading(r"for\s*each\s+(?P<a>\w+)\s+(?:in|of)\b", r"for \g<a> in"),
    leading(r"for\s+(?P<a>\w+)\s+of\b", r"for \g<a> in"),
    leading(r"for\s+\w+\s+in\s+\d+\s*\.\.\s*(?P<a>\d+)", r"repeat \g<a>"),
    leading(r"unless\s+(?P<a>.*?)\s*\{", r"if not (\g<a>) {"),
    leading(r"when\b", "if"),
    leading(r"(?:switch|match|case)\b.*", None, "write `if C { .. } else if C { .. }`"),
    inner(r"\bthen\b\s*(?=\{)", ""),
    leading(rf"if\s+(?P<a>[^{{}}]*?)\s*:?\s+(?P<b>{_CALL})", r"if \g<a> { \g<b> }"),
    leading(rf"(?P<a>{_BLOCK})\s+(?P<b>{_CALL})", r"\g<a> { \g<b> }"),
    leading(r"(?P<a>seq|sel)\s*[\[(](?P<b>.*)[\])]", r"\g<a> {\g<b>}"),
    leading(
        rf"(?P<a>{_BLOCK}|else|if\b.*?|for\b.*?|while\b.*?|with\b.*?)\s*:(?=\s|$)",
        None,
        r"a block stands in braces: `\g<a> { .. }`",
    ),
    leading(
        r"else\b",
        None,
        "`else` follows the `}` of an `if`; a step that follows a failure is the next one in a `sel`",
        "SEQ",
    ),
    leading(r"with\s+(?P<a>.*\))\s+as\s+\w+", r"with \g<a>"),
    leading(
        r"return\b.*", "", "delete it: a step succeeds or fails by itself; a value is given out by `Skill(..) -> name`"
    ),
    leading(r"pass\b", ""),
    leading(r"(?:fail|abort|throw|raise)\s*\(?\s*(?P<a>\"[^\"]*\")\s*\)?", r"fail \g<a>"),
    leading(r"(?:fail|abort|throw|raise)\b.*", None, 'write `fail "REASON"`, or `check(C)` to fail if C does not hold'),
    leading(
        r"(?:break|continue)\b",
        None,
        "a loop ends by its condition, `while C max 10 { .. }`; steps are left out by `if C { .. }`",
    ),
    leading(r"(?:assert|check)\s*\((?P<a>.*)\)\s*$", r"check(\g<a>)"),
    leading(r"(?:assert|check)\s+(?P<a>[^({].*\S)", r"check(\g<a>)"),
    leading(r"(?:print|log|echo)\b.*", "", "delete it: what happens in a run is recorded"),
    leading(r"(?:let|var|const|val|auto)?\s*\b(?P<a>\w+)\s*:?=\s*(?P<b>[A-Z]\w*\(.*\))", r"\g<b> -> \g<a>"),
    leading(r"let\s+(?P<a>\w+)\s*:?=\s*(?P<b>[^=\s].*)", None, _VALUE, "SEQ"),
    leading(rf"(?:{_KIND}\s+)?(?P<a>\w+)\s*:?=\s*(?P<b>.*\S)", None, _VALUE, "LSQB"),
    leading(r"(?:sleep|delay|wait)\s*\(?\s*(?P<a>\d[\d.]*)\s*\)?\s*$", r"wait \g<a> s"),
    leading(r"(?:sleep|delay)\s*\(?\s*(?P<a>\d[\d.]*\s?\w+)\s*\)?", r"wait \g<a>"),
    leading(r"wait_until\b", "wait until"),
    leading(r"wait\s+(?!until\b)(?:for\s+)?(?P<a>[^{}]*[=<>].*\S)", r"wait until \g<a>"),
    leading(r"wait\s+for\b", "wait"),
    leading(r"within\b", "timeout"),
    leading(r"(?:[Pp]arallel\b|par(?=\s*\{))", "par all", _PAR),
    leading(r"(?:[Ss]equence|Seq)\b", "seq"),
    leading(r"(?:[Ss]elector|[Ff]allback|Sel)\b(?=\s*\{)", "sel"),
    leading(r"(?:[Ii]nverter|not)\b(?=\s*\{)", "invert"),
    leading(rf"not\s+(?P<a>{_CALL})", r"invert { \g<a> }"),
    leading(rf"(?:do|run)\s+(?={_CALL})", "", where="SEQ"),
    leading(rf"(?:call|execute|await|start)\s+(?={_CALL})", "", where="LSQB"),
    leading(r"(?:begin|end)\b", None, "a block stands in braces: `{ .. }`"),
    leading(r"(?P<a>\w+)\.(?P<b>[A-Z]\w*)\(\s*\)\s*;?", r"\g<b>(\g<a>)"),
    leading(r"(?P<a>\w+)\.(?P<b>[A-Z]\w*)\(", r"\g<b>(\g<a>, "),
    leading(r"(?P<a>[A-Z]\w*)\s+(?P<b>\w+)\s*$", r"\g<a>(\g<b>)", where="LSQB"),
    leading(r"(?P<a>[A-Z]\w*)\s*$", r"\g<a>()", where="LSQB"),
    leading(r"(?://|/\*+|--)", "#", "a comment begins with `#`"),
)
