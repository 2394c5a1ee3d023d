/** The part of Khronos' validator that tests use; it comes without types. */
declare module "gltf-validator" {
  interface Report {
    readonly issues: {
      readonly numErrors: number;
      readonly numWarnings: number;
      readonly messages: readonly { readonly code: string; readonly message: string; readonly severity: number }[];
    };
    readonly info: {
      readonly totalTriangleCount: number;
      readonly materialCount: number;
      readonly resources?: readonly { readonly mimeType?: string }[];
    };
  }
  export function validateBytes(bytes: Uint8Array, options?: { readonly maxIssues?: number }): Promise<Report>;
}
