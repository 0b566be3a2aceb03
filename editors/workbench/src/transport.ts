// The two ways to a Desk.
import { type Transport, Trouble } from "./protocol";

const GONE = "The workbench does not answer: its program was ended. Start it again. The text here stays: copy it or download it.";

const asWindow = Array.from(crypto.getRandomValues(new Uint8Array(8)), (each) => each.toString(16).padStart(2, "0")).join("");

const asked = (request: Record<string, unknown>): string => JSON.stringify({ window: asWindow, ...request });

function checked<Reply>(reply: Record<string, unknown>): Reply {
  if (typeof reply["trouble"] === "string") throw new Trouble(reply["trouble"] || "This did not work, and nobody said why.", reply);
  return reply as Reply;
}

// To the server that sent this page; the token stands in the page's address.
export class ServerTransport implements Transport {
  private readonly token = new URLSearchParams(location.search).get("token") ?? "";

  async ask<Reply>(request: Record<string, unknown>): Promise<Reply> {
    const headers = { "Content-Type": "application/json", "X-Token": this.token };
    const answer = await fetch("ask", { method: "POST", headers, body: asked(request) }).catch(() => {
      throw new Trouble(GONE);
    });
    const reply: Record<string, unknown> | null = await answer.json().catch(() => null);
    if (!reply || (!answer.ok && !reply["trouble"])) throw new Trouble(`The workbench answers ${answer.status}. Load this page again.`);
    // Another token: the workbench was started anew, and this page belongs to an older one.
    if (answer.status === 403) throw new Trouble(`${String(reply["trouble"])}. The text here stays: copy it or download it.`);
    return checked<Reply>(reply);
  }
}

// To Python in a worker: it is loaded with the first question.
export class WorkerTransport implements Transport {
  private worker: Worker | null = null;
  private readonly waiting = new Map<number, { done: (reply: Record<string, unknown>) => void; failed: (why: Trouble) => void }>();
  private number = 0; // of the last question

  constructor(
    private readonly address: string,
    private readonly tell: (progress: string) => void,
  ) {}

  ask<Reply>(request: Record<string, unknown>): Promise<Reply> {
    const worker = (this.worker ??= this.start());
    const number = (this.number += 1);
    return new Promise<Record<string, unknown>>((done, failed) => {
      this.waiting.set(number, { done, failed });
      worker.postMessage({ number, request: asked(request) });
    }).then((reply) => checked<Reply>(reply));
  }

  private start(): Worker {
    const worker = new Worker(this.address, { type: "module" });
    worker.onmessage = ({ data: [kind, value, number] }) => {
      if (kind === "progress") this.tell(value && `${value} …`);
      else if (kind === "failed") this.fail(value);
      else {
        this.waiting.get(number)?.done(JSON.parse(value));
        this.waiting.delete(number);
      }
    };
    worker.onerror = (event) => this.fail(event.message || "this browser is too old for it");
    return worker;
  }

  private fail(why: string): void {
    this.worker?.terminate();
    this.worker = null;
    this.tell("");
    const said = `Python could not be loaded: ${why}. Is this computer online, and may it read from there? Then try again.`;
    for (const { failed } of this.waiting.values()) failed(new Trouble(said));
    this.waiting.clear();
  }
}
