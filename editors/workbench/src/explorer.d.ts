// What the explorer's front end takes for the widget of a notebook.
declare module "*/notebook/explorer.js" {
  export interface Model {
    get(name: string): unknown;
    set(name: string, value: unknown): void;
    save_changes(): void;
    on(event: string, listener: () => void): void;
    off(event: string, listener: () => void): void;
  }
  const explorer: { render(options: { model: Model; el: HTMLElement }): () => void };
  export default explorer;
}

declare module "*.css" {}
