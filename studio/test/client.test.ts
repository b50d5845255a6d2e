// Requests whose answers do not come whole.
import { afterEach, expect, test, vi } from "vitest";
import { api, ApiError } from "../src/api/client";

afterEach(() => vi.unstubAllGlobals());

test("an answer that is cut off is an error of the request, as views expect it", async () => {
  const cut = new ReadableStream({
    pull: (controller) => controller.error(new TypeError("network error")),
  });
  vi.stubGlobal("fetch", () => Promise.resolve(new Response(cut, { status: 200 })));
  const asked = api.world("yard");
  await expect(asked).rejects.toThrow(ApiError);
  await expect(asked).rejects.toThrow("cut off");
});
