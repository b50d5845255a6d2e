// Writes the types of the OpenAPI document on standard input, without its paths, to src/api/schema.ts or another file.
import { writeFileSync } from "node:fs";
import { text } from "node:stream/consumers";
import openapiTS, { astToString } from "openapi-typescript";

const document = JSON.parse(await text(process.stdin));
const types = astToString(
  await openapiTS({ ...document, paths: {} }, { silent: true, defaultNonNullable: false, arrayLength: true }),
);
const comment = "// Made from the OpenAPI document of the server by `npm run types`; do not edit.\n\n";
const file = process.argv[2] ?? new URL("src/api/schema.ts", import.meta.url);
writeFileSync(file, comment + types);
