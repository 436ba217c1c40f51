// A failure, reported in one sentence on the page.
export class Sentence extends Error {}
