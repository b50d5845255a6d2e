// The keywords and the types of the language; made by `python tests/accept.py`, not edited.

// prettier-ignore
export const KEYWORDS: ReadonlySet<string> = new Set([
  "_", "after", "all", "always", "and", "any", "anywhere", "apply", "as", "backend", "before",
  "between", "by", "check", "class", "cost", "disjoint", "do", "duration", "else", "endless",
  "enum", "eventually", "exists", "expect", "fail", "failure", "fallback", "false", "finally",
  "for", "forall", "function", "functional", "given", "goal", "has", "hold", "if", "impl",
  "implies", "import", "in", "infer", "inverse", "invert", "is", "keep", "lead", "let", "likely",
  "makespan", "max", "minimise", "never", "no", "noplan", "not", "of", "on", "once", "opt", "or",
  "out", "outcome", "outside", "par", "pause", "plan", "possible", "post", "pre", "prefer",
  "prefix", "property", "python", "race", "range", "reactive", "refine", "relation", "repeat",
  "retry", "run", "scene", "scoped", "sel", "sensed", "senses", "seq", "shares", "skill", "some",
  "start", "steps", "sub", "symmetric", "task", "test", "timeout", "tolerance", "transitive",
  "true", "try", "until", "use", "uses", "verify", "wait", "when", "where", "while", "with",
  "within", "work",
]);

// prettier-ignore
export const TYPES: ReadonlySet<string> = new Set([
  "Acceleration", "Angle", "AngularSpeed", "Area", "Bool", "Current", "Direction", "Energy", "Flow",
  "Force", "Frequency", "Int", "Length", "Mass", "Message", "Number", "Pose", "Power", "Pressure",
  "RotationalStiffness", "Speed", "Stiffness", "Temperature", "TemperatureDifference", "Text",
  "Time", "Torque", "Vector", "Voltage", "Volume",
]);
