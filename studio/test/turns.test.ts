// Requests that wait for their turn, and Stop, which waits for none.
import { afterEach, expect, test, vi } from "vitest";
import { api } from "../src/api/client";
import { Turns } from "../src/api/turns";

afterEach(() => vi.unstubAllGlobals());

test("so many go on at once, the others in their order, whatever comes of those before", async () => {
  const turns = new Turns(2);
  const begun: number[] = [];
  const ends: (() => void)[] = [];
  const all = [0, 1, 2, 3].map((number) =>
    turns.take(() => {
      begun.push(number);
      return new Promise<void>((resolve, reject) =>
        ends.push(number === 0 ? () => reject(new Error()) : resolve),
      );
    }),
  );
  await Promise.resolve();
  expect(begun).toEqual([0, 1]);
  ends[0]?.();
  await expect(all[0]).rejects.toThrow();
  await vi.waitFor(() => expect(begun).toEqual([0, 1, 2]));
  ends[1]?.();
  await vi.waitFor(() => expect(begun).toEqual([0, 1, 2, 3]));
  ends.forEach((end) => end());
  await Promise.all(all.slice(1));
});

test("Stop is sent at once however many requests are not answered, and these leave connections free", async () => {
  const sent: string[] = [];
  vi.stubGlobal("fetch", (path: string) => {
    sent.push(path);
    return path.endsWith("/stop")
      ? Promise.resolve(new Response(JSON.stringify({ state: "operational" })))
      : new Promise(() => undefined);
  });
  for (let number = 0; number < 20; number += 1) void api.world("yard");
  await Promise.resolve();
  expect(sent).toHaveLength(4);
  expect(await api.stop("yard", "enough")).toEqual({ state: "operational" });
  expect(sent.at(-1)).toBe("/api/v1/cells/yard/stop");
});
