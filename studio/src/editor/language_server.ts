// The language server over a WebSocket: a message of JSON-RPC a frame; it comes back after a loss.
import type { Position } from "../api/types";

export interface LspPosition {
  line: number;
  character: number;
}
export interface LspRange {
  start: LspPosition;
  end: LspPosition;
}
export interface LspDiagnostic {
  range: LspRange;
  message: string;
  severity?: 1 | 2 | 3 | 4;
  code?: string;
}
export interface LspEdit {
  range: LspRange;
  newText: string;
}
export interface LspCompletion {
  label: string;
  kind?: number;
  detail?: string;
  documentation?: string | { value: string };
  insertText?: string;
  textEdit?: LspEdit;
  additionalTextEdits?: LspEdit[];
}

export interface LspLocation {
  uri: string;
  range: LspRange;
}

interface Message {
  id?: number;
  method?: string;
  params?: unknown;
  result?: unknown;
  error?: { message: string };
}

/** Edits of several texts, by path. */
export type TextEdits = ReadonlyMap<string, readonly LspEdit[]>;

export interface LspCodeAction {
  title: string;
  kind?: string;
  diagnostics?: LspDiagnostic[];
  edit?: { changes?: Record<string, LspEdit[]> };
}

const REFUSED = 1008;
const AGAIN_MS = 2000;
/** How long the answer to what nobody asked for by name is of use. */
const ANSWER_MS = 8000;
/** How long somebody waits for what they asked for: a server that has just started reads the whole library first. */
const DEMANDED_MS = 60_000;
/** How long a server may take to start. */
const START_MS = 60_000;
const LOOK_MS = 100;
/** The kind of a change of a file whose text is another one. */
const CHANGED = 2;

/** A client for the texts of one library; `onDiagnostics` gets what is wrong with a text. */
export class LanguageServer {
  private socket: WebSocket | null = null;
  private number = 0;
  private version = 0;
  private isReady = false;
  private isOver = false;
  private open: { path: string; text: string } | null = null;
  private readonly answers = new Map<number, (answer: Message) => void>();
  /** What the server has said last about each text: it says nothing again while that is the same. */
  private readonly found = new Map<string, LspDiagnostic[]>();

  /** `commands` are those of lenses that the page carries out. */
  constructor(
    private readonly library: string,
    private readonly commands: readonly string[],
    private readonly onDiagnostics: (path: string, found: LspDiagnostic[]) => void,
  ) {
    this.connect();
  }

  /** Tell the text that is edited now. */
  show(path: string, text: string): void {
    const before = this.open;
    this.open = { path, text };
    if (!this.isReady) return;
    if (before?.path === path) {
      const textDocument = { uri: this.uri(path), version: ++this.version };
      this.notify("textDocument/didChange", { textDocument, contentChanges: [{ text }] });
      return;
    }
    if (before !== null)
      this.notify("textDocument/didClose", { textDocument: { uri: this.uri(before.path) } });
    this.tellOpen();
  }

  /** Return what is wrong with a text, as far as the server has said; null if it has said nothing yet. */
  problems(path: string): LspDiagnostic[] | null {
    return this.found.get(path) ?? null;
  }

  /** Tell that a file was changed on disk, by somebody else. */
  changedOnDisk(path: string): void {
    const changes = [{ uri: this.uri(path), type: CHANGED }];
    if (this.isReady) this.notify("workspace/didChangeWatchedFiles", { changes });
  }

  /** Ask something about the open text, at a position if there is one; null if there is no answer. */
  async ask<T>(method: string, more: Record<string, unknown>): Promise<T | null> {
    if (!this.isReady || this.open === null) return null;
    return this.request<T>(method, { textDocument: { uri: this.uri(this.open.path) }, ...more });
  }

  /** Ask something that may be refused: the answer, or why there is none. */
  async demand(
    method: string,
    more: Record<string, unknown>,
  ): Promise<{ result: unknown } | { refused: string }> {
    for (let waited = 0; !this.isReady && waited < START_MS; waited += LOOK_MS)
      await new Promise((resolve) => window.setTimeout(resolve, LOOK_MS));
    if (!this.isReady || this.open === null) return { refused: "The language server has not started." };
    const textDocument = { uri: this.uri(this.open.path) };
    const answer = await this.exchange(method, { textDocument, ...more }, DEMANDED_MS);
    if (answer.error !== undefined) return { refused: answer.error.message };
    if (answer.result == null) return { refused: "The language server did not answer." };
    return { result: answer.result };
  }

  /** Return the edits that an answer has, by path. */
  editsOf(edit: LspCodeAction["edit"]): TextEdits {
    return new Map(Object.entries(edit?.changes ?? {}).map(([uri, edits]) => [this.pathOf(uri), edits]));
  }

  close(): void {
    this.isOver = true;
    this.socket?.close();
  }

  private connect(): void {
    const socket = new WebSocket(`${location.origin.replace(/^http/, "ws")}/api/v1/lsp`);
    this.socket = socket;
    socket.onopen = () => void this.initialize(socket);
    socket.onmessage = (event: MessageEvent<string>) => this.receive(JSON.parse(event.data) as Message);
    socket.onclose = (event) => {
      this.isReady = false;
      for (const answer of this.answers.values()) answer({});
      this.answers.clear();
      this.found.clear();
      if (!this.isOver && event.code !== REFUSED)
        window.setTimeout(() => !this.isOver && this.connect(), AGAIN_MS);
    };
  }

  private async initialize(socket: WebSocket): Promise<void> {
    socket.send(JSON.stringify({ library: this.library }));
    const textDocument = { hover: { contentFormat: ["plaintext"] }, publishDiagnostics: {} };
    const initializationOptions = { commands: this.commands };
    await this.request(
      "initialize",
      { processId: null, rootUri: null, capabilities: { textDocument }, initializationOptions },
      START_MS,
    );
    this.notify("initialized", {});
    this.isReady = true;
    this.tellOpen();
  }

  private tellOpen(): void {
    if (this.open === null) return;
    const { path, text } = this.open;
    const textDocument = { uri: this.uri(path), languageId: "skill", version: ++this.version, text };
    this.notify("textDocument/didOpen", { textDocument });
  }

  private receive(message: Message): void {
    if (message.method === "textDocument/publishDiagnostics") {
      const { uri, diagnostics } = message.params as { uri: string; diagnostics: LspDiagnostic[] };
      this.found.set(this.pathOf(uri), diagnostics);
      this.onDiagnostics(this.pathOf(uri), diagnostics);
    } else if (message.id !== undefined && message.method !== undefined) {
      this.send({ id: message.id, result: null });
    } else if (message.id !== undefined) {
      this.answers.get(message.id)?.(message);
      this.answers.delete(message.id);
    }
  }

  private async request<T>(method: string, params: unknown, patience = ANSWER_MS): Promise<T | null> {
    return ((await this.exchange(method, params, patience)).result ?? null) as T | null;
  }

  private exchange(method: string, params: unknown, patience = ANSWER_MS): Promise<Message> {
    const id = ++this.number;
    this.send({ id, method, params });
    return new Promise((resolve) => {
      const timer = window.setTimeout(() => resolve({}), patience);
      this.answers.set(id, (answer) => {
        window.clearTimeout(timer);
        resolve(answer);
      });
    });
  }

  private notify(method: string, params: unknown): void {
    this.send({ method, params });
  }

  private send(message: Message): void {
    if (this.socket?.readyState === WebSocket.OPEN)
      this.socket.send(JSON.stringify({ jsonrpc: "2.0", ...message }));
  }

  private uri(path: string): string {
    return `skill:///${[this.library, ...path.split("/")].map(encodeURIComponent).join("/")}`;
  }

  private pathOf(uri: string): string {
    return uri
      .replace(/^skill:\/\/\/[^/]*\//, "")
      .split("/")
      .map(decodeURIComponent)
      .join("/");
  }

  /** Return the place that a location of the server means. */
  placeOf(location: LspLocation): Position {
    const { line, character } = location.range.start;
    return { path: this.pathOf(location.uri), line: line + 1, column: character + 1 };
  }
}
