// The address of the page: what follows its `#` logs in, and says which cell and task are wanted.

/** What an address asks for: a code that logs in once, a cell, and a task of it; null for what it does not name. */
export interface Asked {
  code: string | null;
  cell: string | null;
  task: string | null;
}

/** Read what follows the `#` of an address, with it. */
export function readFragment(fragment: string): Asked {
  const values = new URLSearchParams(fragment.replace(/^#/, ""));
  const [code = null, cell = null, task = null] = ["code", "cell", "task"].map(
    (name) => values.get(name) || null,
  );
  return { code, cell, task };
}

/** Write what follows the path of an address that asks for a cell and a task, and has no code any more. */
export function writeFragment({ cell, task }: Omit<Asked, "code">): string {
  const given = Object.entries({ cell, task }).filter((each): each is [string, string] => each[1] !== null);
  return given.length === 0 ? "" : `#${new URLSearchParams(given).toString()}`;
}
