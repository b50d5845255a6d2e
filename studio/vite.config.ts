import { defineConfig } from "vitest/config";

// `npm run dev` shows the page with a server that runs: SKILLC_SERVER is its address without a path. The server has to
// be started with `--host localhost:5173`.
const server = process.env["SKILLC_SERVER"] ?? "http://127.0.0.1:8421";

export default defineConfig({
  base: "/",
  build: {
    outDir: "../app/skillc/studio_files",
    emptyOutDir: true,
    target: "es2022",
    cssTarget: ["chrome123", "firefox120", "safari17.5"],
    modulePreload: { polyfill: false },
    assetsInlineLimit: 0,
    chunkSizeWarningLimit: 900,
    reportCompressedSize: false,
  },
  server: { proxy: { "/api": { target: server, changeOrigin: false, ws: true } } },
  test: { include: ["test/**/*.test.ts"] },
});
