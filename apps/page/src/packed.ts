// Reads what lib/results/page/packed.cpp writes.
import { unzlibSync } from "fflate";

function bytesOfBase64(text: string): Uint8Array {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** The numbers of one packed text, read in the order in which they were added. */
export class Unpacked {
  private readonly bytes: Uint8Array;
  private at = 0;

  constructor(text: string) {
    this.bytes = unzlibSync(bytesOfBase64(text));
  }

  unsigned(): number {
    let value = 0;
    let factor = 1;
    for (;;) {
      if (this.at >= this.bytes.length) throw new Error("a packed text of this page ends too early");
      const byte = this.bytes[this.at++];
      value += (byte & 127) * factor;
      if (byte < 128) return value;
      factor *= 128;
    }
  }

  signed(): number {
    const value = this.unsigned();
    return value % 2 === 0 ? value / 2 : -(value + 1) / 2;
  }

  deltas(count: number): Float64Array {
    const values = new Float64Array(count);
    let last = 0;
    for (let i = 0; i < count; ++i) values[i] = last += this.signed();
    return values;
  }

  secondDeltas(count: number): Float64Array {
    const values = new Float64Array(count);
    let last = 0;
    let delta = 0;
    for (let i = 0; i < count; ++i) values[i] = last += delta += this.signed();
    return values;
  }

  floats(count: number): Float32Array {
    const out = new Float32Array(count);
    const view = new DataView(out.buffer);
    for (let i = 0; i < count; ++i) {
      let bits = 0;
      for (let byte = 3; byte >= 0; --byte) bits = bits * 256 + this.bytes[this.at + byte * count + i];
      view.setUint32(4 * i, bits, true);
    }
    this.at += 4 * count;
    return out;
  }

  raw(count: number): Uint8Array {
    const part = this.bytes.subarray(this.at, this.at + count);
    this.at += count;
    return part;
  }
}

export const deltasOf = (text: string, count: number): Float64Array => new Unpacked(text).deltas(count);
export const floatsOf = (text: string, count: number): Float32Array => new Unpacked(text).floats(count);
