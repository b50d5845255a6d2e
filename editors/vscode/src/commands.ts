// The commands of code lenses: `run`, `plan` and `test` in a terminal, and the references of a declaration.
import {
  commands,
  type Disposable,
  ProcessExecution,
  Task,
  TaskPanelKind,
  TaskScope,
  tasks,
  Uri,
  window,
  workspace,
} from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";
import type { Location, Position } from "vscode-languageserver-protocol";

/** What `skillc` is started with: its arguments, the folder, and the parameters of a task that are asked for. */
interface Started {
  arguments: string[];
  folder: string;
  parameters: string[];
}

/** The commands that the language server may name in code lenses. */
export const LENS_COMMANDS = ["skillc.run", "skillc.plan", "skillc.test", "skillc.showReferences"];

/** Register the commands; `program` is what starts skillc, `client` the running client. */
export function registerLensCommands(
  program: () => string[],
  client: () => LanguageClient | undefined,
): Disposable[] {
  const start = (what: Started): Promise<void> => startProgram(program(), what);
  return [
    ...["skillc.run", "skillc.plan", "skillc.test"].map((name) => commands.registerCommand(name, start)),
    commands.registerCommand("skillc.showReferences", (uri: string, at: Position, places: Location[]) => {
      const converter = client()?.protocol2CodeConverter;
      if (converter === undefined) return;
      const shown = places.map((each) => converter.asLocation(each));
      void commands.executeCommand("editor.action.showReferences", Uri.parse(uri), converter.asPosition(at), shown);
    }),
  ];
}

async function startProgram([command, ...first]: string[], what: Started): Promise<void> {
  const values: string[] = [];
  for (const name of what.parameters) {
    const value = await window.showInputBox({ prompt: `The value of ${name}`, placeHolder: "lab:Table-1" });
    if (value === undefined) return;
    values.push(`${name}=${value}`);
  }
  await workspace.saveAll(false);
  const args = [...first, ...what.arguments, ...values];
  const execution = new ProcessExecution(command, args, { cwd: what.folder });
  const label = what.arguments.join(" ");
  const task = new Task({ type: "skillc" }, TaskScope.Workspace, label, "skillc", execution, []);
  task.presentationOptions = { panel: TaskPanelKind.Dedicated, clear: true };
  await tasks.executeTask(task);
}
