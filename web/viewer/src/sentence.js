// What goes wrong is told in one sentence, on the page.
export class Sentence extends Error {}
