export class ScarpError extends Error {
  constructor(code, message, options) {
    super(message, options);
    this.name = 'ScarpError';
    this.code = code;
  }
}
