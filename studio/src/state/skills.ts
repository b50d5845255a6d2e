// The skills in the world model: what each changes, which robots can do it, and why others cannot.
import type { api } from "../api/client";

type Rows = Awaited<ReturnType<typeof api.query>>["rows"];

/** Why a robot cannot use an implementation. */
export interface Rejection {
  how: string;
  why: string;
}

/** What a robot can do of a skill: `how` are the implementations that it can use, in the order in which they are tried. */
export interface RobotSkill {
  robot: string;
  how: string[];
  rejections: Rejection[];
}

/** A skill with the texts of its postconditions, and with each robot of the cell. */
export interface SkillOfRobots {
  name: string;
  changes: string[];
  robots: RobotSkill[];
}

export const CHANGES = `SELECT ?name ?text {
  ?skill a skiros:Skill ; rdfs:label ?name
  OPTIONAL { ?skill skiros:hasPostCondition ?post . ?post skillc:conditionText ?text ; rdfs:label ?label }
} ORDER BY ?name ?label`;

export const IMPLEMENTATIONS = `SELECT ?name ?robot ?how ?why {
  { ?robot skillc:canRun ?it }
  UNION { ?no a skillc:Rejection ; skillc:rejectedFor ?robot ; skillc:rejects ?it ; skillc:reason ?why }
  ?it skillc:implements ?skill ; skillc:rank ?rank ; rdfs:label ?how . ?skill rdfs:label ?name
} ORDER BY ?robot ?rank`;

/** Return the skills, by name, from the answers to `CHANGES` and `IMPLEMENTATIONS`. */
export function skillsOf(changes: Rows, implementations: Rows): SkillOfRobots[] {
  const found = new Map<string, SkillOfRobots>();
  for (const [name, text] of changes) {
    const skill = entry(found, String(name), () => ({ name: String(name), changes: [], robots: [] }));
    if (typeof text === "string") skill.changes.push(text);
  }
  const robots = new Map<string, RobotSkill>();
  for (const [name, robot, label, why] of implementations) {
    const skill = found.get(String(name));
    if (skill === undefined) continue;
    const one = entry(robots, `${name} ${robot}`, () => {
      const made = { robot: String(robot), how: [], rejections: [] };
      skill.robots.push(made);
      return made;
    });
    const how = String(label).slice(skill.name.length + 1, -1);
    if (typeof why === "string") one.rejections.push({ how, why });
    else one.how.push(how);
  }
  return [...found.values()];
}

function entry<Value>(map: Map<string, Value>, key: string, make: () => Value): Value {
  const known = map.get(key);
  if (known !== undefined) return known;
  const made = make();
  map.set(key, made);
  return made;
}
