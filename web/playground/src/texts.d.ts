// SPDX-License-Identifier: Apache-2.0
declare module '*.wgsl' {
  const text: string;
  export default text;
}
