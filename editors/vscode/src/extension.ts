// Starts `skillc lsp` for `.skill` files and forwards the requests of the editor to it.
import * as path from "node:path";
import { commands, type ExtensionContext, window, workspace } from "vscode";
import { LENS_COMMANDS, registerLensCommands } from "./commands";
import { LanguageClient, type LanguageClientOptions, type ServerOptions } from "vscode-languageclient/node";

let client: LanguageClient | undefined;

/** The command that starts the language server, with its path. */
function configured(): string[] {
  const [command, ...args] = workspace.getConfiguration("skillc").get<string[]>("command") ?? ["skillc", "lsp"];
  const cwd = workspace.workspaceFolders?.[0]?.uri.fsPath;
  const isPath = command.includes("/") || command.includes(path.sep);
  return [isPath && cwd ? path.resolve(cwd, command) : command, ...args];
}

function server(): ServerOptions {
  const [command, ...args] = configured();
  return { command, args, options: { cwd: workspace.workspaceFolders?.[0]?.uri.fsPath } };
}

async function start(): Promise<void> {
  const options: LanguageClientOptions = {
    documentSelector: [{ language: "skill" }, { scheme: "file", pattern: "**/*.ttl" }],
    initializationOptions: { commands: LENS_COMMANDS },
  };
  client = new LanguageClient("skillc", "skillc", server(), options);
  try {
    await client.start();
  } catch (error) {
    client = undefined;
    const reason = error instanceof Error ? error.message : String(error);
    const choice = await window.showErrorMessage(
      `The skill language server did not start (${reason}). Install it with: pip install skillc, ` +
        "or set its command in the setting skillc.command.",
      "Open settings",
    );
    if (choice) await commands.executeCommand("workbench.action.openSettings", "skillc.command");
  }
}

async function restart(): Promise<void> {
  await deactivate();
  await start();
}

export async function activate(context: ExtensionContext): Promise<void> {
  context.subscriptions.push(
    commands.registerCommand("skillc.restart", restart),
    ...registerLensCommands(() => configured().slice(0, -1), () => client),
    workspace.onDidChangeConfiguration((event) => (event.affectsConfiguration("skillc.command") ? restart() : undefined)),
  );
  await start();
}

export async function deactivate(): Promise<void> {
  await client?.stop().catch(() => undefined);
  client = undefined;
}
