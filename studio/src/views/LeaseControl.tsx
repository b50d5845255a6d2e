// The lease of the cell: who has it, in the bar on top; what that means and what can be done about it, one click away.
import { releaseLease, takeLease } from "../state/lease";
import { lease, may, session } from "../state/studio";
import { Icon } from "./icons";
import { Popover } from "./Popover";

export function LeaseControl() {
  const current = lease.value;
  if (current === null) return null;
  const owner = current.owner;
  const isOwn = owner !== null && owner === session.value?.name;
  const [tone, word] =
    owner === null ? ["", "free"] : isOwn ? ["is-running", "yours"] : ["is-waiting", owner];
  return (
    <Popover
      label={`Lease: ${word}`}
      name="Lease of the cell"
      title="Who alone may command this cell"
      tone={tone}
      face={
        <>
          <Icon name={owner === null ? "unlocked" : "locked"} />
          <span class="truncate">{word}</span>
        </>
      }
    >
      {() => (
        <>
          {owner === null && <Free />}
          {isOwn && <Own />}
          {owner !== null && !isOwn && <Others owner={owner} remainingS={current.remaining_s} />}
        </>
      )}
    </Popover>
  );
}

interface ActionProps {
  label: string;
  role: "operate" | "admin";
  act: () => unknown;
}

/** A button, with the reason below it if the role is too low. */
function Action({ label, role, act }: ActionProps) {
  return (
    <>
      <button
        class="primary"
        disabled={!may(role)}
        title={may(role) ? "" : `This needs the role ${role}`}
        onClick={() => void act()}
      >
        {label}
      </button>
      {!may(role) && (
        <p class="small muted">
          This needs the role {role}; you have {session.value?.role}.
        </p>
      )}
    </>
  );
}

function Free() {
  return (
    <>
      <p>Nobody has the lease: whoever has the role operate may command this cell.</p>
      <p class="small muted">With the lease you alone may. It is kept while this page is open.</p>
      <Action label="Take the lease" role="operate" act={() => takeLease()} />
    </>
  );
}

function Own() {
  return (
    <>
      <p>You have the lease: nobody else may command this cell. Everybody may watch and stop it.</p>
      <Action label="Release the lease" role="operate" act={releaseLease} />
    </>
  );
}

function Others({ owner, remainingS }: { owner: string; remainingS: number }) {
  return (
    <>
      <p>
        <strong class="wrap-anywhere">{owner}</strong> has the lease, for {Math.ceil(remainingS)} s unless it
        is prolonged. You may watch and stop.
      </p>
      <Action label="Take it over" role="admin" act={() => takeLease(true)} />
    </>
  );
}
