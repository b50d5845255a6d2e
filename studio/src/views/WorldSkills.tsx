// What the robots of the cell can do by their hardware: each skill with what it changes, and why a robot cannot do it.
import { useEffect, useState } from "preact/hooks";
import { api } from "../api/client";
import { read } from "../state/actions";
import { CHANGES, IMPLEMENTATIONS, type RobotSkill, type SkillOfRobots, skillsOf } from "../state/skills";
import { cellName, library } from "../state/studio";

/** Return the skills of the library of the cell; null until they are read. */
function useSkills(): SkillOfRobots[] | null {
  const [skills, setSkills] = useState<SkillOfRobots[] | null>(null);
  const name = cellName.value;
  const hash = library.value?.hash;
  useEffect(() => {
    if (name === null) return;
    void read(async () => {
      const [changes, implementations] = [
        await api.query(name, CHANGES),
        await api.query(name, IMPLEMENTATIONS),
      ];
      setSkills(skillsOf(changes.rows, implementations.rows));
    });
  }, [name, hash]);
  return skills;
}

/** The skills in which a text occurs, in their names, what they change, the robots or the reasons. */
export function WorldSkills({ search }: { search: string }) {
  const skills = useSkills();
  if (skills === null)
    return (
      <div class="empty" role="status">
        <span class="spinner" />
        Reading what the robots can do
      </div>
    );
  const shown = skills.filter((each) => JSON.stringify(each).toLowerCase().includes(search.toLowerCase()));
  if (shown.length === 0) return <div class="empty">No skill has “{search}” in it.</div>;
  return (
    <table class="skills">
      <thead>
        <tr>
          <th>skill</th>
          <th>changes</th>
          <th>robots, by their hardware</th>
        </tr>
      </thead>
      <tbody>
        {shown.map((each) => (
          <tr key={each.name}>
            <td>{each.name}</td>
            <td class="mono">
              {each.changes.map((text) => (
                <div key={text}>{text}</div>
              ))}
            </td>
            <td>
              {each.robots.map((one) => (
                <Robot key={one.robot} one={one} />
              ))}
              {each.robots.length === 0 && <span class="muted">the cell has no robot</span>}
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/** A robot: how it can do the skill, or why it cannot. */
function Robot({ one }: { one: RobotSkill }) {
  const reasons = one.rejections.map((each) => (
    <div key={each.how} class="small muted wrap-anywhere">
      not {each.how}: {each.why}
    </div>
  ));
  if (one.how.length === 0)
    return (
      <div>
        {one.robot} <span class="badge is-bad">cannot</span>
        {reasons}
      </div>
    );
  return (
    <details>
      <summary>
        {one.robot} <span class="badge is-good">can</span> <span class="muted">{one.how.join(", ")}</span>
      </summary>
      {reasons.length > 0 ? reasons : <div class="small muted">by each implementation</div>}
    </details>
  );
}
