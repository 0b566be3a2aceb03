// Fields of a sketch, or of a line or arc of it: each shows a value, and changes it.
import { make, newId, type Option, select, textField } from "./dom";
import type { Values } from "./chainSketch";

type Value = string | boolean;
type Input = HTMLInputElement | HTMLSelectElement | HTMLTextAreaElement;

type Access<Of> = { read: (of: Of) => Value; write: (of: Of, value: Value) => void };
// A label where the title alone does not tell it; whether its meaning stands beside it.
type Described = { label?: string; meaning?: string; isTold?: boolean };

export class Fields<Of extends { facts?: string[] }> {
  private readonly all = new Map<string, { input: Input; access: Access<Of>; hint: HTMLElement | null }>();

  // `change` hears the name of a field that is being typed in, and an empty one for what is done at once.
  constructor(private readonly change: (name: string, by: (of: Of) => void) => void) {}

  own(name: keyof Of): Access<Of> {
    return { read: (of) => (of[name] ?? "") as Value, write: (of, value) => void (of[name] = value as Of[typeof name]) };
  }

  within(name: keyof Of, key: string): Access<Of> {
    const table = (of: Of) => (of[name] ?? {}) as Values;
    return { read: (of) => table(of)[key] ?? "", write: (of, value) => void (of[name] = { ...table(of), [key]: value } as Of[typeof name]) };
  }

  private bind<Kind extends Input>(name: string, input: Kind, access: Access<Of>, hint: HTMLElement | null = null): Kind {
    const isTyped = input.matches("textarea, [type=text]");
    input.dataset["field"] = name;
    input.addEventListener(isTyped ? "input" : "change", () => this.change(isTyped ? name : "", (of) => access.write(of, isCheck(input) ? input.checked : input.value)));
    this.all.set(name, { input, access, hint });
    return input;
  }

  text(title: string, name: string, access: Access<Of>, { label, meaning, isTold }: Described = {}): HTMLLabelElement {
    const hint = make("span", { class: "hint", id: newId() });
    const input = this.bind(name, textField({ "aria-describedby": hint.id, "aria-label": label }), access, hint);
    const isCode = name !== title && !title.endsWith(name) && /^[A-Z\d]+$/.test(name) && !title.startsWith("End ");
    const code = isCode && make("span", { class: "code", text: name });
    return make("label", { title: meaning }, make("span", { class: "name" }, title, code, isTold && make("span", { class: "meaning", text: meaning })), input, hint);
  }

  choice(label: string, name: string, options: readonly Option[], access: Access<Of>): HTMLSelectElement {
    return this.bind(name, select(options, { "aria-label": label }), access);
  }

  check(text: string, name: keyof Of & string): HTMLLabelElement {
    return make("label", { class: "check" }, this.bind(name, make("input", { type: "checkbox" }), this.own(name)), text);
  }

  statements(title: string, label: string, placeholder: string): HTMLLabelElement {
    const area = make("textarea", { rows: 2, "aria-label": label, placeholder, spellcheck: "false" });
    const access: Access<Of> = { read: (of) => (of.facts ?? []).join("\n"), write: (of, value) => void (of.facts = String(value).split("\n")) };
    return make("label", {}, make("span", { class: "name", text: title }), this.bind("facts", area, access));
  }

  show(of: Of, wrong: Set<string>, hintOf: (name: string) => string): void {
    for (const [name, { input, access, hint }] of this.all) {
      const value = access.read(of);
      if (isCheck(input)) input.checked = value === true;
      else if (input.value !== value) input.value = String(value);
      if (hint || isCheck(input)) input.setAttribute("aria-invalid", String(wrong.has(name) || wrong.has(name.split(".")[0]!)));
      const told = hintOf(name);
      if (hint && hint.textContent !== told) hint.textContent = told;
    }
  }
}

const isCheck = (input: Input): input is HTMLInputElement => input instanceof HTMLInputElement && input.type === "checkbox";
